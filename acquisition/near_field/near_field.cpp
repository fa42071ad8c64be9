#include "acquisition/near_field/near_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "shared/near_light.h"

namespace nacre {

namespace {

constexpr double kFarthestLight = 1000; // widths: beyond it units were mixed, metres and millimetres

// The least rotation that turns a unit vector of positive z to (0,0,1): Rodrigues' formula about v x z, whose sine and
// cosine are its length and v.z.
glm::mat3 rotationToFront(const glm::vec3& v)
{
    const float x = v.x, y = v.y, c = v.z, k = 1 / (1 + c);
    // Columns: images of the axes.
    return {{c + k * y * y, -k * x * y, x}, {-k * x * y, c + k * x * x, y}, {-x, -y, c}};
}

// Where the files' middle is, in pixels of the capture, which may be a part of them.
glm::dvec2 middleOfFiles(const Capture& capture)
{
    const FileWindow& w = capture.window;
    return w.fileWidth == 0
               ? glm::dvec2(capture.width, capture.height) / 2.0
               : glm::dvec2(w.fileWidth / 2.0 - w.x, w.fileHeight / 2.0 - w.y) / static_cast<double>(w.box);
}

double cameraDistanceOf(const Capture& capture)
{
    const FileWindow& w = capture.window;
    const double width = w.fileWidth == 0 ? capture.width : w.fileWidth / static_cast<double>(w.box);
    return capture.fieldOfView ? width / 2 / std::tan(glm::radians(*capture.fieldOfView) / 2)
                               : std::numeric_limits<double>::infinity();
}

bool isHarmless(double widths)
{
    return glm::degrees(std::atan2(0.5, widths)) < kHarmlessTurn;
}

[[noreturn]] void refusePlace(const Capture& capture, size_t photograph, const std::string& where,
                              const std::string& expected)
{
    throw Error(capture.lightsSource.empty() ? capture.folder : std::filesystem::path(capture.lightsSource),
                fmt::format("puts the light of {} {}", capture.photographs[photograph].name, where), expected);
}

// A light `widths` from the object's middle.
void requireReachable(const Capture& capture, size_t photograph, double widths)
{
    if (widths < kNearestLight) {
        refusePlace(
            capture, photograph, fmt::format("at {:.2f} widths from the object's middle, inside it", widths),
            fmt::format("places or a distance in the unit of the object's width, {} widths or more", kNearestLight));
    }
    if (std::isfinite(widths) && widths > kFarthestLight) {
        refusePlace(
            capture, photograph, fmt::format("at {:.0f} widths from the object", widths),
            fmt::format("places or a distance in the unit of the object's width, {:g} widths at most", kFarthestLight));
    }
}

void requireBefore(const Capture& capture, size_t photograph)
{
    const float height = capture.lightPlaces[photograph].z;
    if (height < 0) {
        refusePlace(capture, photograph, fmt::format("{:.2f} widths behind the object's plane", -height),
                    "places with z towards the camera, from the object's middle on");
    }
}

bool arePlaced(const std::vector<Light>& lights)
{
    return !lights.empty() &&
           std::all_of(lights.begin(), lights.end(), [](const Light& light) { return std::isfinite(light.distance); });
}

} // namespace

ObjectExtent extentOf(const Capture& capture)
{
    std::vector<uint32_t> pixels;
    for (size_t pixel = 0; pixel < capture.mask.size(); ++pixel) {
        if (capture.mask[pixel]) {
            pixels.push_back(static_cast<uint32_t>(pixel));
        }
    }
    return extentOf(pixels, capture.width);
}

std::optional<NearField> nearFieldOf(const Capture& capture, const std::vector<size_t>& photographs,
                                     const std::vector<Light>& lights)
{
    NearField near = cameraOf(capture);
    const double width = extentOf(capture).width;
    double nearest = std::numeric_limits<double>::infinity();
    if (!capture.lightPlaces.empty()) {
        for (const size_t photograph : photographs) {
            const glm::vec3& place = capture.lightPlaces[photograph];
            requireReachable(capture, photograph, glm::length(place));
            requireBefore(capture, photograph);
            nearest = std::min<double>(nearest, glm::length(place));
            near.lights.push_back(static_cast<float>(width) * place);
        }
    } else if (arePlaced(lights)) {
        for (size_t i = 0; i < lights.size(); ++i) {
            requireReachable(capture, photographs[i], lights[i].distance);
            nearest = std::min<double>(nearest, lights[i].distance);
            near.lights.push_back(static_cast<float>(width) * lights[i].distance * lights[i].direction);
        }
    } else if (capture.lightDistance && std::isfinite(*capture.lightDistance)) {
        requireReachable(capture, photographs.front(), *capture.lightDistance);
        nearest = *capture.lightDistance;
        near = withLightsAt(near, lights, nearest * width);
    }
    if (isHarmless(nearest)) {
        near.lights.clear();
    }
    const bool hasLens = !isHarmless(near.cameraDistance / width);
    return near.lights.empty() && !hasLens ? std::nullopt : std::optional(near);
}

std::optional<glm::vec3> cameraPlaceOf(const NearField& near, double width)
{
    if (std::isinf(near.cameraDistance)) {
        return std::nullopt;
    }
    return glm::vec3(glm::dvec3(near.axis.x - near.origin.x, near.origin.y - near.axis.y, near.cameraDistance) / width);
}

NearField cameraOf(const Capture& capture)
{
    return {{}, cameraDistanceOf(capture), extentOf(capture).middle, middleOfFiles(capture)};
}

NearField withLightsAt(NearField near, const std::vector<Light>& lights, double distance)
{
    near.lights.clear();
    near.depth = 0;
    for (const Light& light : lights) {
        near.lights.push_back(static_cast<float>(distance) * light.direction);
    }
    return near;
}

std::vector<Light> placedLights(const Capture& capture, const std::vector<size_t>& photographs,
                                std::vector<Light> lights, const std::optional<NearField>& near)
{
    if (!near || near->lights.empty()) {
        return lights;
    }
    const glm::vec3 depth(0, 0, near->depth);
    const float width = static_cast<float>(extentOf(capture).width);
    const float distance = glm::length(near->lights.front() - depth);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3 said = !capture.lightPlaces.empty()        ? width * capture.lightPlaces[photographs[i]]
                               : std::isfinite(lights[i].distance) ? width * lights[i].distance * lights[i].direction
                                                                   : distance * lights[i].direction;
        const glm::vec3 place = said + depth;
        lights[i].direction = glm::normalize(place);
        lights[i].distance = glm::length(place) / width;
    }
    return lights;
}

// The pixel's ray meets the plane at (u, v, 0) from the axis; the point is on it at the height given.
LocalFrame frameAt(const NearField& near, uint32_t pixel, int width, float height)
{
    const uint32_t column = pixel % static_cast<uint32_t>(width), row = pixel / static_cast<uint32_t>(width);
    const double x = column + 0.5, y = row + 0.5;
    LocalFrame frame;
    if (std::isinf(near.cameraDistance)) {
        frame.place = glm::vec3(x - near.origin.x, near.origin.y - y, height);
        return frame;
    }
    const glm::dvec2 onPlane(x - near.axis.x, near.axis.y - y);
    const glm::dvec2 there = onPlane * (1 - height / near.cameraDistance);
    const glm::vec3 view =
        glm::normalize(glm::dvec3(-there.x, -there.y, near.cameraDistance - static_cast<double>(height)));
    frame.place = glm::vec3(there.x + near.axis.x - near.origin.x, there.y + near.origin.y - near.axis.y, height);
    frame.toLocal = rotationToFront(view);
    return frame;
}

Light lightAt(const NearField& near, const LocalFrame& frame, const Light& light, size_t index)
{
    if (near.lights.empty()) {
        return {frame.toLocal * light.direction, light.irradiance};
    }
    const float distance = glm::length(near.lights[index]);
    const glm::vec4 met = lightFromPlace(near.lights[index] / distance, 1 / distance, frame.place);
    return {frame.toLocal * glm::vec3(met), light.irradiance * met.w};
}

} // namespace nacre
