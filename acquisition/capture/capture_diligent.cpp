// Shi et al., A Benchmark Dataset and Evaluation for Non-Lambertian and Uncalibrated Photometric Stereo (DiLiGenT),
// 2016: filenames.txt lists the photographs, light_directions.txt their lights in the camera frame (x right, y up,
// z to the camera), light_intensities.txt the lights' RGB irradiances.
#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/picture_files.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kDirections = "light_directions.txt";
constexpr const char* kIntensities = "light_intensities.txt";

LightFile loadDiligentLights(const fs::path& folder)
{
    LightFile result;
    for (const glm::vec3& direction : loadDirections(folder / kDirections)) {
        result.lights.push_back({direction, glm::vec3(1)});
    }
    if (!fs::exists(folder / kIntensities)) {
        return result;
    }
    const std::vector<glm::vec3> irradiances = loadIrradiances(folder / kIntensities);
    if (irradiances.size() != result.lights.size()) {
        throw Error(folder / kIntensities,
                    fmt::format("has {} lights, {} has {}", irradiances.size(), kDirections, result.lights.size()),
                    "as many");
    }
    for (size_t i = 0; i < irradiances.size(); ++i) {
        result.lights[i].irradiance = irradiances[i];
    }
    result.irradianceGiven = true;
    return result;
}

} // namespace

std::optional<LayoutContents> readDiligentLayout(const fs::path& folder)
{
    const fs::path listing = folder / "filenames.txt";
    if (!fs::exists(listing)) {
        return std::nullopt;
    }
    LayoutContents contents;
    contents.capture.layout = CaptureLayout::diligent;
    contents.listing = listing;
    for (const std::string& name : loadTextLines(listing)) {
        if (!fs::exists(folder / name)) {
            throw Error(folder / name, "does not exist", "a photograph, as filenames.txt lists it");
        }
        contents.capture.photographs.push_back(photographOf(folder / name));
    }
    if (fs::exists(folder / kDirections)) {
        assignLights(contents, loadDiligentLights(folder), folder / kDirections);
    }
    for (const fs::path& file : picturesIn(folder)) {
        if (lowerCase(file.stem().string()) == "mask") {
            contents.masks.push_back(file);
        }
    }
    for (const char* truth : {"Normal_gt.png", "Normal_gt.mat"}) { // the last one wins: it is not rounded
        if (fs::exists(folder / truth)) {
            contents.capture.truthNormals = folder / truth;
        }
    }
    return contents;
}

} // namespace nacre
