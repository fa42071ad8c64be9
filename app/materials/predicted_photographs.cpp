#include "app/materials/predicted_photographs.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/rti/hsh_file.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr float kMostPolar = 60;      // degrees
constexpr float kBlack = 16.0f / 255; // JPEG and the fit leave no background black

} // namespace

RtiPicture loadRelightable(const fs::path& source)
{
    const char* expected = "FILE.ptm, FILE.rti or a folder with info.json";
    if (!fs::exists(source)) {
        throw Error(source, "does not exist", expected);
    }
    if (fs::is_directory(source)) {
        return loadRtiWeb(source);
    }
    const std::string extension = lowerExtension(source);
    if (extension == ".ptm") {
        return rtiFromPtm(loadPtm(source));
    }
    if (extension == ".rti") {
        return loadHsh(source);
    }
    throw Error(source, "is no relightable picture", expected);
}

std::vector<glm::vec3> predictedLights(int count)
{
    std::vector<glm::vec3> lights = rtiLights(count);
    const float radius = std::sin(glm::radians(kMostPolar));
    for (glm::vec3& light : lights) {
        const float x = radius * light.x, y = radius * light.y;
        light = {x, y, std::sqrt(1 - x * x - y * y)};
    }
    return lights;
}

void writePredictedCapture(const fs::path& folder, const RtiPicture& picture, const std::vector<glm::vec3>& lights,
                           const fs::path& source, int threads)
{
    Image mask(picture.width(), picture.height(), 1);
    nlohmann::json photographs;
    for (const glm::vec3& light : lights) {
        const Image codes = relit(picture, light, threads);
        for (size_t i = 0; i < codes.values.size(); ++i) {
            mask.values[i / 3] = codes.values[i] > kBlack ? 1.0f : mask.values[i / 3];
        }
        const std::string name = fmt::format("predicted_{:02}.png", photographs.size() + 1);
        saveImage(folder / name, codes, PixelType::uint8);
        photographs.push_back(
            {{"file", name}, {"light", {{"direction", {light.x, light.y, light.z}}, {"irradiance", {1, 1, 1}}}}});
    }
    if (std::none_of(mask.values.begin(), mask.values.end(), [](float inside) { return inside > 0; })) {
        throw Error(source, "is black under every light", "a picture of an object");
    }
    saveImage(folder / "mask.png", mask, PixelType::uint8);
    const nlohmann::json capture = {{"format", "nacre capture"},
                                    {"version", 1},
                                    {"transfer", "srgb"},
                                    {"mask", "mask.png"},
                                    {"photographs", photographs}};
    writeTextFile(folder / "capture.json", capture.dump(2));
}

} // namespace nacre
