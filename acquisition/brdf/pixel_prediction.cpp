#include "acquisition/brdf/pixel_prediction.h"

#include <glm/geometric.hpp>

#include "acquisition/brdf/light_slices.h"
#include "acquisition/normals/intensities.h"

namespace nacre {

TableUnderLights tableUnder(const LocalLights& lights, const BrdfTable& table)
{
    if (lights.areDistant() && table.domain.coordinates != kNatural) {
        return [slices = LightSlices(table, lights.reference())](const glm::vec3& normal, std::span<const Light>,
                                                                 std::span<glm::vec3> values) {
            slices.evaluate(normal, values);
        };
    }
    return [&table](const glm::vec3& normal, std::span<const Light> own, std::span<glm::vec3> values) {
        for (size_t i = 0; i < own.size(); ++i) {
            values[i] = evaluateTable(table, normal, own[i].direction, {0, 0, 1}).value;
        }
    };
}

bool predictPixel(const Observations& block, size_t p, const glm::vec3& normal, std::span<const Light> lights,
                  const TableUnderLights& table, PixelPrediction& pixel)
{
    pixel.lights.clear();
    pixel.observed.clear();
    pixel.predicted.resize(lights.size());
    table(normal, lights, pixel.predicted);
    std::vector<float> greys;
    for (size_t i = 0; i < lights.size(); ++i) {
        const float nDotL = glm::dot(normal, lights[i].direction);
        const glm::vec3 observed = block.radianceOf(p)[i] / lights[i].irradiance;
        greys.push_back(greyOf(observed));
        if (nDotL > 0 && !block.saturatedOf(p)[i]) {
            pixel.predicted[pixel.observed.size()] = pixel.predicted[i] * nDotL;
            pixel.observed.push_back(observed);
            pixel.lights.push_back(i);
        }
    }
    pixel.limit = kRefitLimit * brightLevel(greys);
    return pixel.limit > 0;
}

} // namespace nacre
