#include "evaluation/held_out/transfer_error.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kSphereSize = 64; // pixels across
// The outermost normals look along the surface.
constexpr float kLargestRadius = 0.99f;

std::vector<glm::vec3> sphereNormals()
{
    std::vector<glm::vec3> normals;
    for (int y = 0; y < kSphereSize; ++y) {
        for (int x = 0; x < kSphereSize; ++x) {
            const glm::vec2 disc((2 * x + 1.0f) / kSphereSize - 1, 1 - (2 * y + 1.0f) / kSphereSize);
            const float square = glm::dot(disc, disc);
            if (square < kLargestRadius) {
                normals.emplace_back(disc, std::sqrt(1 - square));
            }
        }
    }
    return normals;
}

} // namespace

TransferError transferError(const BrdfInterpolant& interpolant, const TableDomain& domain, const glm::vec3& scale,
                            const BrdfModel& truth, const std::vector<Light>& lights, int threads)
{
    const glm::vec3 v(0, 0, 1);
    const std::vector<glm::vec3> normals = sphereNormals();
    std::vector<glm::vec3> expected(normals.size() * lights.size(), glm::vec3(0)), shown = expected;
    parallelFor(normals.size(), 16, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            for (size_t i = 0; i < lights.size(); ++i) {
                const glm::vec3& l = lights[i].direction;
                const float nDotL = glm::dot(normals[p], l);
                if (nDotL > 0) {
                    const glm::vec3 unit = unitFromDirections(domain, normals[p], l, v);
                    expected[p * lights.size() + i] = evaluate(truth, normals[p], l, v) * nDotL;
                    shown[p * lights.size() + i] = interpolant(unit).value * scale * nDotL;
                }
            }
        }
    });
    std::vector<float> values;
    for (const glm::vec3& radiance : expected) {
        values.insert(values.end(), {radiance.x, radiance.y, radiance.z});
    }
    const auto brightest = static_cast<size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    TransferError error;
    error.peakRatio = shown[brightest / 3][static_cast<int>(brightest % 3)] / values[brightest];
    const float peak = quantile(values, 0.99);
    double sum = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        const glm::vec3 miss = glm::clamp(expected[i] / peak, 0.0f, 1.0f) - glm::clamp(shown[i] / peak, 0.0f, 1.0f);
        sum += glm::dot(miss, miss);
    }
    error.psnr = -10 * std::log10(std::max(sum / (3 * static_cast<double>(expected.size())), 1e-30));
    return error;
}

} // namespace nacre
