#include "acquisition/normals.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/scene/error.h"
#include "engine/scene/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kPixelsPerTask = 1024;

struct NamedMethod {
    const char* name;
    NormalMethod method;
};

constexpr NamedMethod kMethods[] = {{"least-squares", NormalMethod::leastSquares},
                                    {"threshold", NormalMethod::threshold}};

// I / E as grey, per light: what a light of irradiance 1 would show.
void normaliseIntensities(std::span<const glm::vec3> radiance, const std::vector<Light>& lights,
                          std::vector<float>& out)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        out[i] = greyOf(radiance[i] / lights[i].irradiance);
    }
}

void keepBetween(std::span<const float> intensities, float low, float high, std::vector<uint8_t>& use)
{
    for (size_t i = 0; i < intensities.size(); ++i) {
        use[i] = intensities[i] > low && intensities[i] < high;
    }
}

// The paper's manual thresholds, or shares of the pixel's own sorted observations.
void keepByThreshold(std::span<const float> intensities, const NormalOptions& options, std::vector<float>& sorted,
                     std::vector<uint8_t>& use)
{
    if (options.lowThreshold >= 0 && options.highThreshold > options.lowThreshold) {
        keepBetween(intensities, options.lowThreshold, options.highThreshold, use);
        return;
    }
    sorted.assign(intensities.begin(), intensities.end());
    std::sort(sorted.begin(), sorted.end());
    const size_t n = sorted.size();
    const size_t dark = static_cast<size_t>(options.darkestShare * n);
    const size_t bright = std::min(static_cast<size_t>(options.brightestShare * n), n - dark - 1);
    const float low = sorted[dark], high = sorted[n - 1 - bright];
    for (size_t i = 0; i < n; ++i) {
        use[i] = intensities[i] >= low && intensities[i] <= high && intensities[i] > 0;
    }
}

} // namespace

NormalMethod normalMethodFromName(const std::string& name)
{
    std::string names;
    for (const NamedMethod& method : kMethods) {
        if (name == method.name) {
            return method.method;
        }
        names += (names.empty() ? "" : ", ") + std::string(method.name);
    }
    throw Error("", fmt::format("--normals {} is no method", name), "one of " + names, Error::kUsage);
}

std::string nameOf(NormalMethod method)
{
    for (const NamedMethod& named : kMethods) {
        if (named.method == method) {
            return named.name;
        }
    }
    return {};
}

std::vector<PixelNormal> estimateNormals(const Observations& block, const std::vector<Light>& lights,
                                         const NormalOptions& options)
{
    const LambertianSolver solver(lights);
    std::vector<PixelNormal> normals(block.pixels.size());
    parallelFor(normals.size(), kPixelsPerTask, options.threads, [&](size_t first, size_t last) {
        std::vector<float> intensities(lights.size()), sorted;
        std::vector<uint8_t> use(lights.size(), 1);
        for (size_t p = first; p < last; ++p) {
            normaliseIntensities(block.radianceOf(p), lights, intensities);
            if (options.method == NormalMethod::leastSquares) {
                normals[p] = solver.solve(intensities);
            } else {
                keepByThreshold(intensities, options, sorted, use);
                normals[p] = solver.solve(intensities, use);
            }
        }
    });
    return normals;
}

} // namespace nacre
