#include "engine/viewer/light_ball_picture.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr size_t kFewLights = 16; // of which the light ball's few pixels are drawn sooner than another ball is made

// The surface's most frequent material.
size_t mostFrequentMaterial(const Surface& surface)
{
    std::array<size_t, 256> counts{};
    for (const uint8_t label : surface.labels) {
        ++counts[label];
    }
    const auto end = counts.begin() + static_cast<std::ptrdiff_t>(surface.materials.size());
    return static_cast<size_t>(std::max_element(counts.begin(), end) - counts.begin());
}

} // namespace

void LightBallPicture::setSurface(const Surface& surface)
{
    material_ = mostFrequentMaterial(surface);
    directSize_ = 0;
}

const Texture& LightBallPicture::draw(ViewPictures& pictures, int size)
{
    if (const Texture* ball = pictures.renderer().drawMaterialBall(material_, size)) {
        return *ball;
    }
    if (directSize_ != size) {
        directSize_ = size;
        direct_.setSurface(
            transferredSurface(sphereNormalMap(directSize_), pictures.scene().main->surface.materials[material_]));
    }
    direct_.setPath(pictures.lights().size() <= kFewLights ? RenderPath::direct : RenderPath::automatic);
    std::vector<Light> distant(pictures.lights().begin(), pictures.lights().end());
    for (Light& light : distant) {
        light.distance = Light().distance;
    }
    direct_.setLights(distant);
    direct_.setDisplay(pictures.display());
    direct_.drawPicture();
    return direct_.drawnPicture();
}

Image materialThumbnail(const Context& context, const Material& material, int size)
{
    Renderer renderer(context);
    renderer.setPath(RenderPath::direct); // one small picture is not worth measuring the ball's size
    renderer.setSurface(transferredSurface(sphereNormalMap(size), material));
    const std::array lights = {Light{.direction = glm::normalize(glm::vec3(-0.4f, 0.5f, 0.8f))}};
    renderer.setLights(lights);
    renderer.setDisplay({.exposureStops = renderer.automaticExposure()});
    return renderer.picture();
}

} // namespace nacre
