#include "engine/scene/false_colour.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/scene/coverage.h"
#include "engine/scene/reference.h"
#include "shared/light_frame.h"

namespace nacre {
namespace {

float brightness(const Light& light)
{
    return light.irradiance.x + light.irradiance.y + light.irradiance.z;
}

bool isShown(const Scene& scene, size_t pixel)
{
    const Surface& surface = scene.surface;
    return surface.normals.confidence[pixel] > 0 && surface.labels[pixel] < surface.materials.size() &&
           glm::dot(surface.normals.normals[pixel], scene.view) > 0;
}

glm::vec3 rounded(const glm::vec3& code)
{
    return glm::round(code * 255.0f) / 255.0f;
}

Image hatchedPicture(const Scene& scene, const Display& display, int threads)
{
    const Surface& surface = scene.surface;
    std::vector<uint8_t> known;
    for (const Material& material : surface.materials) {
        known.push_back(knowsCoverage(material.table));
    }
    const PixelLights lights(surface, scene.lights, scene.view);
    Image picture = displayedImage(renderReference(scene, threads), display);
    for (size_t pixel = 0; pixel < picture.pixelCount(); ++pixel) {
        if (isShaded(surface, pixel) && glm::dot(surface.normals.normals[pixel], lights.view(pixel)) > 0 &&
            known[surface.labels[pixel]] && certaintyOf(surface, pixel, lights).isUncertain) {
            const auto x = static_cast<int>(pixel % picture.width), y = static_cast<int>(pixel / picture.width);
            picture.setRgb(x, y, rounded(hatched(picture.rgb(x, y), {x, y})));
        }
    }
    return picture;
}

} // namespace

FalseColourConstants falseColourConstants(std::span<const Light> lights, const glm::vec3& view, size_t materials)
{
    FalseColourConstants constants{glm::vec4(view, 0), glm::vec4(0), glm::vec4(0), static_cast<int>(materials)};
    const auto brightest = std::max_element(
        lights.begin(), lights.end(), [](const Light& a, const Light& b) { return brightness(a) < brightness(b); });
    if (brightest != lights.end()) {
        const LightFrame frame = lightFrame(brightest->direction, view, brightest->irradiance);
        constants.view.w = frame.across.w;
        constants.half_ = glm::vec4(glm::vec3(frame.half_), 0);
        constants.light = glm::vec4(brightest->direction, 1);
    }
    return constants;
}

Image referenceFalseColour(const Scene& scene, Show show, const Display& display, int threads)
{
    assert(show != Show::picture);
    if (show == Show::coverage) {
        return hatchedPicture(scene, display, threads);
    }
    const Surface& surface = scene.surface;
    const FalseColourConstants constants = falseColourConstants(scene.lights, scene.view, surface.materials.size());
    Image picture(surface.normals.width, surface.normals.height, 3);
    for (size_t pixel = 0; pixel < picture.pixelCount(); ++pixel) {
        if (isShown(scene, pixel)) {
            const glm::vec3 code =
                falseColour(static_cast<int>(show), surface.normals.normals[pixel], surface.labels[pixel], constants);
            picture.setRgb(static_cast<int>(pixel % picture.width), static_cast<int>(pixel / picture.width),
                           rounded(code));
        }
    }
    return picture;
}

} // namespace nacre
