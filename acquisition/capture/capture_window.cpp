#include "acquisition/capture/capture_window.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"

namespace nacre {

namespace {

// visit(pixel of the capture, pixel of the file) for every pixel of a box, box by box.
template <class Visit> void forEachBoxPixel(const Capture& capture, Visit&& visit)
{
    const FileWindow& w = capture.window;
    for (int y = 0; y < capture.height; ++y) {
        for (int x = 0; x < capture.width; ++x) {
            for (int step = 0; step < w.box * w.box; ++step) {
                const size_t row = static_cast<size_t>(w.y) + y * w.box + step / w.box;
                visit(static_cast<size_t>(y) * capture.width + x, row * w.fileWidth + w.x + x * w.box + step % w.box);
            }
        }
    }
}

} // namespace

void fitWindow(Capture& capture, int fileWidth, int fileHeight, const std::filesystem::path& listing)
{
    FileWindow& w = capture.window;
    w.fileWidth = fileWidth;
    w.fileHeight = fileHeight;
    if (w.width == 0) {
        w.width = fileWidth;
        w.height = fileHeight;
    }
    if (w.x > fileWidth - w.width || w.y > fileHeight - w.height) {
        throw Error(listing, fmt::format("crops to {} x {} from ({}, {})", w.width, w.height, w.x, w.y),
                    fmt::format("a part of the photographs' {} x {} pixels", fileWidth, fileHeight));
    }
    capture.width = w.width / w.box;
    capture.height = w.height / w.box;
    if (capture.width == 0 || capture.height == 0) {
        throw Error(listing, fmt::format("scales {} x {} pixels by 1/{} to nothing", w.width, w.height, w.box),
                    "at least one pixel");
    }
}

std::vector<uint8_t> windowedMask(const std::vector<uint8_t>& mask, const Capture& capture,
                                  const std::filesystem::path& file)
{
    std::vector<uint8_t> result(static_cast<size_t>(capture.width) * capture.height, uint8_t{1});
    forEachBoxPixel(capture, [&](size_t pixel, size_t filePixel) { result[pixel] &= mask[filePixel]; });
    if (std::find(result.begin(), result.end(), uint8_t{1}) == result.end()) {
        throw Error(file, "is empty inside the capture's crop", "some of the object there");
    }
    return result;
}

std::vector<uint8_t> windowedMarks(const std::vector<uint8_t>& marks, const Capture& capture)
{
    std::vector<uint8_t> result(static_cast<size_t>(capture.width) * capture.height, uint8_t{0});
    forEachBoxPixel(capture, [&](size_t pixel, size_t filePixel) { result[pixel] |= marks[filePixel]; });
    return result;
}

std::vector<uint8_t> windowedLabels(const std::vector<uint8_t>& labels, const Capture& capture)
{
    const size_t boxPixels = static_cast<size_t>(capture.window.box) * capture.window.box;
    std::vector<uint8_t> result(static_cast<size_t>(capture.width) * capture.height);
    std::vector<uint8_t> box;
    forEachBoxPixel(capture, [&](size_t pixel, size_t filePixel) {
        box.push_back(labels[filePixel]);
        if (box.size() == boxPixels) {
            std::sort(box.begin(), box.end());
            const auto count = [&](uint8_t label) { return std::count(box.begin(), box.end(), label); };
            result[pixel] =
                *std::max_element(box.begin(), box.end(), [&](uint8_t a, uint8_t b) { return count(a) < count(b); });
            box.clear();
        }
    });
    return result;
}

NormalMap windowedNormals(const NormalMap& normals, const Capture& capture, const std::filesystem::path& file)
{
    const FileWindow& w = capture.window;
    if (normals.width != w.fileWidth || normals.height != w.fileHeight) {
        throw Error(file, fmt::format("is {}x{}", normals.width, normals.height),
                    fmt::format("normals of the photographs' size, {}x{}", w.fileWidth, w.fileHeight));
    }
    NormalMap result(capture.width, capture.height);
    std::fill(result.confidence.begin(), result.confidence.end(), 1.0f);
    forEachBoxPixel(capture, [&](size_t pixel, size_t filePixel) {
        result.normals[pixel] += normals.normals[filePixel];
        result.confidence[pixel] = std::min(result.confidence[pixel], normals.confidence[filePixel]);
    });
    for (size_t i = 0; i < result.normals.size(); ++i) {
        const float length = glm::length(result.normals[i]);
        const bool known = result.confidence[i] > 0 && length > 0;
        result.normals[i] = known ? result.normals[i] / length : glm::vec3(0);
        result.confidence[i] = known ? result.confidence[i] : 0;
    }
    return result;
}

} // namespace nacre
