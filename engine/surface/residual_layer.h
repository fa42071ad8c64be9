#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/lights/light.h"
#include "engine/lights/light_plane.h"
#include "shared/residual.h"

namespace nacre {

// What a captured surface shows beyond its BRDF (cast shadows, interreflection, what normals get wrong), as a
// difference that adds over lights: under a light of irradiance 1 a pixel shows
//     trust * BRDF + sum over components k of weight_k(light) * component_k(pixel),
// where weights are thin-plate splines over the plane of lights with the captured lights as nodes. Outside the captured
// lights' hull weights go on half as fast as the light; from two to four of the lights' spacings away they fade out and
// the BRDF is trusted wholly. For the captured pose and the view from the front alone.
struct ResidualLayer {
    int width = 0, height = 0;
    int components = 0;           // 0: there is no layer
    std::vector<uint8_t> codes;   // [(layer * pixels + pixel) * kComponentsPerTexel + component % kComponentsPerTexel]
    std::vector<float> low;       // one a component: its value at code 0
    std::vector<float> high;      // and at code 255
    float trust = 1;              // share of the BRDF's radiance that stays
    std::vector<glm::vec2> nodes; // captured lights, lightPlanePoint
    std::vector<glm::vec3>
        weights; // [component * (nodes + 3) + term]: RGB factors of each node's kernel, of 1, x and y

    bool empty() const { return components == 0; }
    size_t pixelCount() const { return static_cast<size_t>(width) * height; }
    size_t layers() const { return (components + kComponentsPerTexel - 1) / kComponentsPerTexel; }
    size_t terms() const { return nodes.size() + 3; }
};

inline constexpr int kMostResidualComponents = kMostResidualLayers * kComponentsPerTexel;

// off: the BRDF alone, wholly trusted. alone: the sum over components, about middle grey.
enum class ResidualUse { on, off, alone };

// What the layer says of one light.
struct ResidualLight {
    float trust = 1;                // share of the BRDF's radiance
    float presence = 0;             // of the layer, 1 where lights were captured to 0 where it has faded out
    std::vector<glm::vec3> weights; // one a component, for irradiance 1
};

// Where splines are asked for the light at `point`: there inside the hull, half as far beyond it outside.
glm::vec2 pacedOutside(const LightHull& hull, const glm::vec2& point);

// Evaluates a layer's splines.
class ResidualLights {
public:
    explicit ResidualLights(const ResidualLayer& layer);
    ResidualLight at(const glm::vec3& direction) const;

private:
    const ResidualLayer& layer_;
    double spacing_;
    LightHull hull_;
};

// A frame's: `base` are the lights that the BRDF sees, `weights` what the components add.
struct ResidualFrame {
    std::vector<Light> base;
    ResidualWeights weights{};
};
ResidualFrame residualFrame(const ResidualLayer& layer, std::span<const Light> lights,
                            ResidualUse use = ResidualUse::on);

// Radiance that the layer adds to one pixel, possibly below 0; the sum with the BRDF's is clamped at 0.
glm::vec3 residualOfPixel(const ResidualLayer& layer, const ResidualWeights& weights, size_t pixel);

// The layer of pixels picked one by one: pixel i of the answer is `from[i]`; negative ones have codes 0.
ResidualLayer pickedResidual(const ResidualLayer& layer, const std::vector<int64_t>& from, int width, int height);

// Of its component pictures and its weights in memory.
size_t bytesOf(const ResidualLayer& layer);

} // namespace nacre
