#include "acquisition/capture/capture_maps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <matio.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr int kMaskRowsAtOnce = 64; // few enough for memory, enough to make up for what each call costs

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

std::vector<uint8_t> alphaMask(const std::filesystem::path& file)
{
    const int channels = readImageHeader(file).channels;
    if (channels != 2 && channels != 4) {
        return {};
    }
    const Image image = loadImage(file);
    std::vector<uint8_t> mask;
    for (size_t i = static_cast<size_t>(channels) - 1; i < image.values.size(); i += channels) {
        mask.push_back(image.values[i] > 0.5f ? 1 : 0);
    }
    const auto [least, most] = std::minmax_element(mask.begin(), mask.end());
    return *least == *most ? std::vector<uint8_t>() : mask;
}

MaskPicture loadMask(const std::filesystem::path& file, int width, int height)
{
    // Masks hold shape, not light: no curve. By rows, since a mask is as large as its photographs.
    ImageRows rows(file, TransferCurve::linear);
    const ImageHeader& header = rows.header();
    if (width != 0 && (header.width != width || header.height != height)) {
        const bool isTurned = header.width == height && header.height == width;
        throw Error(file,
                    fmt::format("is {} x {}{}", header.width, header.height, isTurned ? ", turned on its side" : ""),
                    fmt::format("{} x {} as the photographs", width, height));
    }
    std::vector<uint8_t> mask = alphaMask(file);
    if (!mask.empty()) {
        return {std::move(mask), true};
    }
    const int channels = rows.channels();
    mask.reserve(static_cast<size_t>(header.width) * header.height);
    std::vector<float> values;
    for (int y = 0; y < header.height; y += kMaskRowsAtOnce) {
        const int last = std::min(y + kMaskRowsAtOnce, header.height);
        values.resize(static_cast<size_t>(last - y) * header.width * channels);
        rows.read(y, last, values);
        for (auto pixel = values.begin(); pixel != values.end(); pixel += channels) {
            mask.push_back(*std::max_element(pixel, pixel + channels) > 0.5f ? 1 : 0);
        }
    }
    if (std::find(mask.begin(), mask.end(), uint8_t{1}) == mask.end()) {
        throw Error(file, "is an empty mask", "the object brighter than one half");
    }
    return {std::move(mask), false};
}

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

namespace {

using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

double valueAt(const matvar_t& variable, size_t index)
{
    return variable.class_type == MAT_C_SINGLE ? static_cast<const float*>(variable.data)[index]
                                               : static_cast<const double*>(variable.data)[index];
}

bool isNormalArray(const matvar_t& variable)
{
    return variable.rank == 3 && variable.dims[2] == 3 &&
           (variable.class_type == MAT_C_DOUBLE || variable.class_type == MAT_C_SINGLE) && variable.data;
}

// Column-major: index = row + height * (column + width * channel).
NormalMap mapOf(const matvar_t& variable)
{
    const size_t height = variable.dims[0], width = variable.dims[1];
    NormalMap map(static_cast<int>(width), static_cast<int>(height));
    for (size_t y = 0; y < height; ++y) {
        for (size_t x = 0; x < width; ++x) {
            glm::dvec3 n;
            for (int c = 0; c < 3; ++c) {
                n[c] = valueAt(variable, y + height * (x + width * c));
            }
            const double size = glm::length(n);
            if (std::isfinite(size) && size > 0.5) {
                map.normals[y * width + x] = glm::vec3(n / size);
                map.confidence[y * width + x] = 1;
            }
        }
    }
    return map;
}

} // namespace

NormalMap loadTrueNormals(const std::filesystem::path& file)
{
    if (file.extension() != ".mat") {
        return loadNormalMap(file);
    }
    const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY), &Mat_Close);
    const char* expected = "a MATLAB file with a real h x w x 3 array of normals";
    if (!mat) {
        throw Error(file, "cannot be read", expected);
    }
    while (true) {
        const MatVariable variable(Mat_VarReadNext(mat.get()), &Mat_VarFree);
        if (!variable) {
            throw Error(file, "holds no normals", expected);
        }
        if (isNormalArray(*variable)) {
            return mapOf(*variable);
        }
    }
}

} // namespace nacre
