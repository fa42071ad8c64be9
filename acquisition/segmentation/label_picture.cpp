#include "acquisition/segmentation/label_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "acquisition/capture/capture_window.h"
#include "acquisition/segmentation/segment_options.h"
#include "engine/files/error.h"
#include "engine/files/image.h"

namespace nacre {

namespace {

constexpr uint32_t kBlack = 0;

// 8 bits a channel; alpha does not count, and a colour picture may hold greys.
uint32_t codeOf(const Image& picture, size_t pixel)
{
    const float* value = &picture.values[pixel * picture.channels];
    const auto code = [](float v) { return static_cast<uint32_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255)); };
    return picture.channels < 3 ? code(value[0]) : code(value[0]) << 16 | code(value[1]) << 8 | code(value[2]);
}

std::string nameOfCode(uint32_t code, bool grey)
{
    return grey ? fmt::format("{}", code) : fmt::format("{:06x}", code);
}

// Codes become indices in ascending order; black becomes kUnlabelled.
std::vector<uint8_t> indexed(const std::vector<uint32_t>& codes, std::map<uint32_t, uint8_t>& index,
                             const std::filesystem::path& file)
{
    for (const uint32_t code : codes) {
        if (code != kBlack) {
            index.emplace(code, uint8_t{0});
        }
        if (index.size() > kMostMaterials) {
            throw Error(file, fmt::format("has more than {} different values", kMostMaterials),
                        "labels: one value or colour for each material, black for none, no smooth edges");
        }
    }
    uint8_t next = 0;
    for (auto& [code, number] : index) {
        number = next++;
    }
    std::vector<uint8_t> labels(codes.size(), kUnlabelled);
    for (size_t i = 0; i < codes.size(); ++i) {
        if (codes[i] != kBlack) {
            labels[i] = index.at(codes[i]);
        }
    }
    return labels;
}

// Without the labels that no pixel of the object has.
LabelPicture compacted(LabelPicture picture, const std::vector<uint8_t>& mask, const std::filesystem::path& file)
{
    std::vector<uint8_t> to(picture.names.size(), kUnlabelled);
    for (size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] && picture.labels[i] != kUnlabelled) {
            to[picture.labels[i]] = 0;
        }
    }
    std::vector<std::string> names;
    for (size_t label = 0; label < to.size(); ++label) {
        if (to[label] == 0) {
            to[label] = static_cast<uint8_t>(names.size());
            names.push_back(picture.names[label]);
        }
    }
    if (names.empty()) {
        throw Error(file, "is black on all of the object", "a value or colour for each material");
    }
    for (uint8_t& label : picture.labels) {
        label = label == kUnlabelled ? kUnlabelled : to[label];
    }
    picture.names = std::move(names);
    return picture;
}

} // namespace

LabelPicture loadLabelPicture(const std::filesystem::path& file, const Capture& capture)
{
    const Image image = loadImage(file);
    const FileWindow& w = capture.window;
    if (image.width != w.fileWidth || image.height != w.fileHeight) {
        throw Error(file, fmt::format("is {} x {}", image.width, image.height),
                    fmt::format("{} x {} as the photographs", w.fileWidth, w.fileHeight));
    }
    std::vector<uint32_t> codes(image.pixelCount());
    for (size_t i = 0; i < codes.size(); ++i) {
        codes[i] = codeOf(image, i);
    }
    std::map<uint32_t, uint8_t> index;
    LabelPicture picture{windowedLabels(indexed(codes, index, file), capture), {}};
    for (const auto& [code, number] : index) {
        picture.names.push_back(nameOfCode(code, image.channels < 3));
    }
    return compacted(std::move(picture), capture.mask, file);
}

} // namespace nacre
