#include "engine/surface/object_places.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/lens.h"
#include "shared/near_light.h"

namespace nacre {

ObjectExtent extentOf(std::span<const uint32_t> pixels, int width)
{
    glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
    for (const uint32_t pixel : pixels) {
        const glm::dvec2 corner(pixel % static_cast<uint32_t>(width), pixel / static_cast<uint32_t>(width));
        least = glm::min(least, corner);
        most = glm::max(most, corner + 1.0);
    }
    return {0.5 * (least + most), std::max(most.x - least.x, most.y - least.y)};
}

namespace {

bool isAtOutline(const NormalMap& normals, int x, int y)
{
    const auto hasNone = [&](int u, int v) {
        return u < 0 || v < 0 || u >= normals.width || v >= normals.height ||
               normals.confidence[normals.index(u, v)] <= 0;
    };
    return !hasNone(x, y) && (hasNone(x - 1, y) || hasNone(x + 1, y) || hasNone(x, y - 1) || hasNone(x, y + 1));
}

std::vector<uint32_t> pixelsWithNormal(const NormalMap& normals)
{
    std::vector<uint32_t> pixels;
    for (size_t i = 0; i < normals.confidence.size(); ++i) {
        if (normals.confidence[i] > 0) {
            pixels.push_back(static_cast<uint32_t>(i));
        }
    }
    return pixels;
}

} // namespace

ObjectExtent extentOf(const NormalMap& normals)
{
    return extentOf(pixelsWithNormal(normals), normals.width);
}

float outlineHeight(const NormalMap& normals, const Image& height)
{
    double sum = 0, count = 0;
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            if (isAtOutline(normals, x, y)) {
                sum += height.values[normals.index(x, y)];
                ++count;
            }
        }
    }
    return count > 0 ? static_cast<float>(sum / count) : 0.0f;
}

glm::vec4 viewpointOf(const Surface& surface, const glm::vec3& view)
{
    if (!surface.camera || !isFromTheFront(view)) {
        return {view, 0};
    }
    const float distance = glm::length(*surface.camera);
    return {*surface.camera / distance, 1 / distance};
}

std::vector<glm::vec3> pixelPlaces(const Surface& surface)
{
    if (!surface.places.empty()) {
        return surface.places;
    }
    const NormalMap& normals = surface.normals;
    const std::vector<uint32_t> pixels = pixelsWithNormal(normals);
    const ObjectExtent extent = extentOf(pixels, normals.width);
    const bool hasHeight = !surface.height.values.empty();
    const float plane = hasHeight ? outlineHeight(normals, surface.height) : 0.0f;
    const glm::vec4 viewpoint = viewpointOf(surface, kFrontView);
    std::vector<glm::vec3> places(normals.normals.size(), glm::vec3(0));
    for (const uint32_t pixel : pixels) {
        const uint32_t column = pixel % static_cast<uint32_t>(normals.width),
                       row = pixel / static_cast<uint32_t>(normals.width);
        const double x = column + 0.5, y = row + 0.5;
        const double z = hasHeight ? surface.height.values[pixel] - plane : 0;
        const glm::dvec3 place = glm::dvec3(x - extent.middle.x, extent.middle.y - y, z) / extent.width;
        places[pixel] = placeOnRay(viewpoint, glm::vec2(place), static_cast<float>(place.z));
    }
    return places;
}

Image heightInPicture(const Surface& surface)
{
    Image height = surface.height;
    const glm::vec4 viewpoint = viewpointOf(surface, kFrontView);
    if (viewpoint.w == 0) {
        return height;
    }
    const NormalMap& normals = surface.normals;
    const auto width = static_cast<float>(extentOf(normals).width);
    const float plane = outlineHeight(normals, height);
    for (float& z : height.values) {
        const glm::vec4 image = pointInPicture(viewpoint, {0, 0, (z - plane) / width, 1});
        z = width * image.z / image.w;
    }
    return height;
}

bool anyIsNear(std::span<const Light> lights)
{
    return std::any_of(lights.begin(), lights.end(), isNear);
}

bool needsPlaces(const Surface& surface, std::span<const Light> lights, const glm::vec3& view)
{
    return anyIsNear(lights) || viewpointOf(surface, view).w > 0;
}

Light lightAt(const Light& light, const glm::vec3& place)
{
    if (!isNear(light)) {
        return light;
    }
    const glm::vec4 met = lightFromPlace(light.direction, 1 / light.distance, place);
    return {glm::vec3(met), met.w * light.irradiance};
}

} // namespace nacre
