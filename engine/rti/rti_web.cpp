#include "engine/rti/rti_web.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kQuality = 95; // of JPEG, as relight's default

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

RtiBasis basisOf(const fs::path& file, const json& info)
{
    for (const RtiBasis basis : {RtiBasis::ptm, RtiBasis::hsh}) {
        if (info.at("type") == rtiBasisName(basis) && info.at("colorspace") == "rgb" &&
            info.at("nplanes") == 3 * rtiTermCount(basis)) {
            return basis;
        }
    }
    throw Error(file,
                fmt::format("is of type {}, colour space {}, {} planes", info.at("type").dump(),
                            info.at("colorspace").dump(), info.at("nplanes").dump()),
                "ptm with 18 or hsh with 27 planes, rgb");
}

Quantisation readQuantisation(const fs::path& file, const json& info, size_t planes)
{
    const json& material = info.at("materials").at(0);
    Quantisation quantisation{material.at("scale"), material.at("bias")};
    if (quantisation.scale.size() != planes || quantisation.bias.size() != planes) {
        throw Error(file,
                    fmt::format("has {} scales and {} biases", quantisation.scale.size(), quantisation.bias.size()),
                    fmt::format("one for each of {} planes", planes));
    }
    return quantisation;
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
    json directions = json::array();
    for (const glm::vec3& light : lights) {
        directions.insert(directions.end(), {light.x, light.y, light.z});
    }
    const json info = {{"width", picture.width()},
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
    const fs::path file = folder / "info.json";
    try {
        const json info = json::parse(readTextFile(file));
        RtiPicture picture{basisOf(file, info), {}};
        const Quantisation quantisation = readQuantisation(file, info, 3 * rtiTermCount(picture.basis));
        for (size_t k = 0; k < rtiTermCount(picture.basis); ++k) {
            picture.terms.push_back(loadPlane(planeFile(folder, k), info.at("width"), info.at("height"),
                                              &quantisation.scale[3 * k], &quantisation.bias[3 * k]));
        }
        return picture;
    } catch (const json::exception& e) {
        throw Error(file, fmt::format("is not understood: {}", e.what()), "the info.json of an RTI for the web");
    }
}

} // namespace nacre
