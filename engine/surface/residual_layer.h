#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/lights/light.h"
#include "engine/lights/light_plane.h"
#include "shared/residual.h"

namespace nacre {

// What a captured surface shows beyond its BRDF (cast shadows, interreflection, what normals get wrong), as a
// difference that adds over lights: under a light of irradiance 1 a pixel shows
//     trust * BRDF + sum over components k of weight_k(light) * component_k(pixel),
// where weights are interpolated from those of the captured lights by lightCovariance. From two to four of the lights'
// spacings outside their hull they fade out and the BRDF is trusted wholly. For the captured pose and the view from the
// front alone.
struct ResidualLayer {
    int width = 0, height = 0;
    int components = 0;           // 0: there is no layer
    std::vector<uint8_t> codes;   // [(layer * pixels + pixel) * kComponentsPerTexel + component % kComponentsPerTexel]
    std::vector<float> low;       // one a component: its value at code 0
    std::vector<float> high;      // and at code 255
    float trust = 1;              // share of the BRDF's radiance that stays
    std::vector<glm::vec3> nodes; // directions of the captured lights
    std::vector<glm::vec3> weights; // [component * nodes + node]: RGB factors of lightCovariance with each node

    bool empty() const { return components == 0; }
    size_t pixelCount() const { return static_cast<size_t>(width) * height; }
    size_t layers() const { return (components + kComponentsPerTexel - 1) / kComponentsPerTexel; }
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

// Evaluates a layer's weights.
class ResidualLights {
public:
    explicit ResidualLights(const ResidualLayer& layer);
    ResidualLight at(const glm::vec3& direction) const;

private:
    const ResidualLayer& layer_;
    std::vector<glm::vec2> points_; // of the nodes
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
