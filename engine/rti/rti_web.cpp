#include "engine/rti/rti_web.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/files/strict_json.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kQuality = 95; // of JPEG, as relight's default
constexpr int kMostPlanes = 1000;
constexpr int kMostPixels = 1 << 16; // a side, as JPEG has it

// v = value / scale + bias lies in [0, 1].
struct Quantisation {
    std::vector<float> scale; // by term, then channel
    std::vector<float> bias;
};

fs::path planeFile(const fs::path& folder, size_t term)
{
    return folder / fmt::format("plane_{}.jpg", term);
}

// 0 is always in the range, so that a pixel without the object is black.
void measureRange(const Image& term, int channel, Quantisation& quantisation)
{
    float low = 0, high = 0;
    for (size_t i = channel; i < term.values.size(); i += 3) {
        low = std::min(low, term.values[i]);
        high = std::max(high, term.values[i]);
    }
    const float scale = high > low ? high - low : 1;
    quantisation.scale.push_back(scale);
    quantisation.bias.push_back(-low / scale);
}

Quantisation quantisationOf(const RtiPicture& picture)
{
    Quantisation quantisation;
    for (const Image& term : picture.terms) {
        for (int channel = 0; channel < 3; ++channel) {
            measureRange(term, channel, quantisation);
        }
    }
    return quantisation;
}

void savePlane(const fs::path& file, Image plane, const float* scale, const float* bias)
{
    for (size_t i = 0; i < plane.values.size(); ++i) {
        plane.values[i] = plane.values[i] / scale[i % 3] + bias[i % 3];
    }
    // Channels are unlike each other here, unlike a photograph's: none is stored at a lower resolution.
    saveImage(file, plane, PixelType::uint8,
              {{"Compression", fmt::format("jpeg:{}", kQuality)}, {"jpeg:subsampling", "4:4:4"}});
}

RtiBasis basisOf(const JsonNode& info)
{
    const std::string type = info.at("type").text(), colours = info.at("colorspace").text();
    const int planes = info.at("nplanes").whole(1, kMostPlanes);
    for (const RtiBasis basis : {RtiBasis::ptm, RtiBasis::hsh}) {
        if (type == rtiBasisName(basis) && colours == "rgb" && planes == 3 * static_cast<int>(rtiTermCount(basis))) {
            return basis;
        }
    }
    throw info.error(fmt::format("is of type {}, colour space {}, {} planes", type, colours, planes),
                     "ptm with 18 or hsh with 27 planes, rgb");
}

Quantisation readQuantisation(const JsonNode& info, size_t planes)
{
    const std::vector<JsonNode> materials = info.at("materials").items();
    if (materials.size() != 1) {
        throw info.at("materials").error(fmt::format("has {} elements", materials.size()), "one");
    }
    return {materials[0].at("scale").floats(planes), materials[0].at("bias").floats(planes)};
}

Image loadPlane(const fs::path& file, int width, int height, const float* scale, const float* bias)
{
    Image plane = loadImage(file);
    if (plane.width != width || plane.height != height || plane.channels != 3) {
        throw Error(file, fmt::format("is {} x {} of {} channels", plane.width, plane.height, plane.channels),
                    fmt::format("{} x {} of 3 as info.json says", width, height));
    }
    for (size_t i = 0; i < plane.values.size(); ++i) {
        plane.values[i] = (plane.values[i] - bias[i % 3]) * scale[i % 3];
    }
    return plane;
}

} // namespace

void saveRtiWeb(const fs::path& folder, const RtiPicture& picture, std::span<const glm::vec3> lights)
{
    const Quantisation quantisation = quantisationOf(picture);
    for (size_t k = 0; k < picture.terms.size(); ++k) {
        savePlane(planeFile(folder, k), picture.terms[k], &quantisation.scale[3 * k], &quantisation.bias[3 * k]);
    }
    nlohmann::json directions = nlohmann::json::array();
    for (const glm::vec3& light : lights) {
        directions.insert(directions.end(), {light.x, light.y, light.z});
    }
    const nlohmann::json info = {{"width", picture.width()},
                                 {"height", picture.height()},
                                 {"format", "jpg"},
                                 {"type", rtiBasisName(picture.basis)},
                                 {"colorspace", "rgb"},
                                 {"nplanes", 3 * picture.terms.size()},
                                 {"quality", kQuality},
                                 {"lights", directions},
                                 {"materials", {{{"scale", quantisation.scale}, {"bias", quantisation.bias}}}}};
    writeTextFile(folder / "info.json", info.dump(1) + "\n");
}

RtiPicture loadRtiWeb(const fs::path& folder)
{
    const JsonNode info = JsonNode::load(folder / "info.json");
    RtiPicture picture{basisOf(info), {}};
    const int width = info.at("width").whole(1, kMostPixels), height = info.at("height").whole(1, kMostPixels);
    const Quantisation quantisation = readQuantisation(info, 3 * rtiTermCount(picture.basis));
    for (size_t k = 0; k < rtiTermCount(picture.basis); ++k) {
        picture.terms.push_back(
            loadPlane(planeFile(folder, k), width, height, &quantisation.scale[3 * k], &quantisation.bias[3 * k]));
    }
    return picture;
}

} // namespace nacre
