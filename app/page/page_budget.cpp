#include "app/page/page_budget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/materials/agreement.h"
#include "engine/files/error.h"
#include "engine/page/page_shape.h"
#include "engine/scene/reference.h"

namespace nacre {
namespace {

// How much of radiance over irradiance one code of each component is, under the captured light that it matters most
// for.
std::vector<float> codeStrengths(const ResidualLayer& layer)
{
    std::vector<float> strengths(layer.components, 0.0f);
    const ResidualLights captured(layer);
    for (const glm::vec3& node : layer.nodes) {
        const ResidualLight light = captured.at(node);
        for (int k = 0; k < layer.components; ++k) {
            const glm::vec3 weight = glm::abs(light.weights[k]);
            const float strength = std::max({weight.x, weight.y, weight.z}) * (layer.high[k] - layer.low[k]) / 255;
            strengths[k] = std::max(strengths[k], strength);
        }
    }
    return strengths;
}

// The layer rounded to steps of so much radiance over irradiance, the same for all components: what is weaker goes,
// what is stronger stays (reverse water-filling: Cover, Thomas, Elements of Information Theory, 2006, 10.3.3).
ResidualLayer roundedLayer(const ResidualLayer& layer, float step)
{
    ResidualLayer rounded = layer;
    const std::vector<float> strengths = codeStrengths(layer);
    for (int k = 0; k < layer.components; ++k) {
        const float codes = std::max(1.0f, std::floor(step / std::max(strengths[k], 1e-12f)));
        const float zero = -255 * layer.low[k] / std::max(layer.high[k] - layer.low[k], 1e-12f);
        const size_t first = k / kComponentsPerTexel * layer.pixelCount();
        for (size_t pixel = 0; pixel < layer.pixelCount(); ++pixel) {
            uint8_t& code = rounded.codes[(first + pixel) * kComponentsPerTexel + k % kComponentsPerTexel];
            const float value = zero + codes * std::round((static_cast<float>(code) - zero) / codes);
            code = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
        }
    }
    return rounded;
}

// Of the surface under its captured lights.
float peakOverIrradiance(const Surface& surface)
{
    Scene scene{judgedSurface(surface), {}};
    float largest = 0;
    for (const Light& light : judgedLights(surface)) {
        scene.lights = {light};
        const Frame frame = renderReference(scene);
        const glm::vec3& e = light.irradiance;
        largest = std::max(largest, std::exp2(-automaticExposure(frame)) / std::max({e.x, e.y, e.z, 1e-12f}));
    }
    return largest;
}

size_t bytesOf(const std::vector<PageParts::Share>& shares, const std::string& kind)
{
    const auto found =
        std::find_if(shares.begin(), shares.end(), [&](const auto& share) { return share.kind == kind; });
    return found == shares.end() ? 0 : found->bytes;
}

// The layer by the finest steps of which it has at most `bytes`; none where all have more.
ResidualLayer layerWithin(const Surface& own, size_t bytes)
{
    constexpr int kSteps = 28; // from 1/1024 of the peak to an eighth, by fourth roots of 2
    const float peak = peakOverIrradiance(own);
    ResidualLayer taken;
    Surface object = own;
    for (int first = 0, end = kSteps; first < end;) {
        const int middle = (first + end) / 2;
        object.residual = roundedLayer(own.residual, peak * std::exp2(0.25f * static_cast<float>(middle) - 10));
        PageParts parts;
        describeShape("", object, {true, false}, parts);
        if (bytesOf(parts.shares(), kResidualPart) > bytes) {
            first = middle + 1;
        } else {
            end = middle;
            taken = object.residual;
        }
    }
    return taken;
}

} // namespace

double pageDecibels(const Surface& page, const Surface& own)
{
    Scene shown{judgedSurface(page), {}};
    return agreementDecibels(judgedSurface(own), [&](std::span<const Light> lights) {
        shown.lights.assign(lights.begin(), lights.end());
        return renderReference(shown);
    });
}

void fitIntoBudget(PageContent& content, size_t budget)
{
    if (budget == 0) {
        return;
    }
    const PageText text = makePage(content);
    if (text.html.size() <= budget) {
        return;
    }
    const size_t rest = text.html.size() - bytesOf(text.shares, kResidualPart);
    if (rest > budget) {
        throw Error("", fmt::format("--budget-bytes {} is too little", budget),
                    fmt::format("{} or more; --size, fewer shapes or photographs make a page smaller", rest),
                    Error::kUsage);
    }
    if (!content.object.residual.empty()) {
        content.object.residual = layerWithin(content.object, budget - rest);
    }
}

} // namespace nacre
