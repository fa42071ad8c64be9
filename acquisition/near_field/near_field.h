#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"
#include "engine/lights/light.h"
#include "engine/surface/object_places.h"

namespace nacre {

// Where lights and camera stand: x right, y up, z towards the camera, in pixels of the picture. The origin is the
// middle of the mask's bounding box, on the plane that heights count from.
struct NearField {
    std::vector<glm::vec3> lights;                                   // places, one a light; empty: all are distant
    double cameraDistance = std::numeric_limits<double>::infinity(); // from the plane; infinite: orthographic
    glm::dvec2 origin{0};                                            // image coordinates (capture.h, Circle)
    glm::dvec2 axis{0}; // where the camera's axis meets the plane, image coordinates
    double depth = 0;   // by which the lights stand nearer to the camera than they are said to
};

// Of the capture's mask.
ObjectExtent extentOf(const Capture& capture);

// What the capture itself says of `lights`, which are those of `photographs`: their places, the lights' own distances,
// or one distance of all from the object's middle; its field of view. None where camera and lights are so far that
// directions towards them turn by less than kHarmlessTurn over the object. Throws Error (data) where a light stands
// inside the object, behind it, or so far that units must have been mixed.
std::optional<NearField> nearFieldOf(const Capture& capture, const std::vector<size_t>& photographs,
                                     const std::vector<Light>& lights);
inline constexpr double kHarmlessTurn = 0.5; // degrees from the object's middle to its edge

// Where the camera stands, as places of a surface are (object_places.h); none: it is orthographic. `width`: of the
// object, in pixels.
std::optional<glm::vec3> cameraPlaceOf(const NearField& near, double width);

// The camera alone.
NearField cameraOf(const Capture& capture);
// Lights at one distance from the object's middle along their directions.
NearField withLightsAt(NearField near, const std::vector<Light>& lights, double distance);
// `lights`, those of `photographs`, as they stand before the object's middle: where the capture has their places, at
// these, else at the one distance of near's; all at near's depth. Distant where near's are.
std::vector<Light> placedLights(const Capture& capture, const std::vector<size_t>& photographs,
                                std::vector<Light> lights, const std::optional<NearField>& near);

// A point of the surface as its pixel sees it: the pixel's own frame has z towards the camera.
struct LocalFrame {
    glm::vec3 place{0};
    glm::mat3 toLocal{1}; // a rotation from the camera frame
};

// `height` above the plane, in pixels.
LocalFrame frameAt(const NearField& near, uint32_t pixel, int width, float height);

// A light as a point meets it, in the point's frame. `light` is as the origin meets it: irradiance falls off with the
// square of the distance.
Light lightAt(const NearField& near, const LocalFrame& frame, const Light& light, size_t index);

} // namespace nacre
