#include "acquisition/chain/self_lit_choice.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace nacre {

namespace {

constexpr size_t kPixelsPerPart = 65536;

Observations rangeOf(const Observations& block, size_t first, size_t last)
{
    const auto slice = [](const auto& values, size_t from, size_t to) {
        return std::vector(values.begin() + static_cast<std::ptrdiff_t>(from),
                           values.begin() + static_cast<std::ptrdiff_t>(to));
    };
    const size_t n = block.lightCount;
    return {n,
            slice(block.pixels, first, last),
            slice(block.radiance, first * n, last * n),
            slice(block.saturated, first * n, last * n),
            block.width,
            block.spacing};
}

Finding describeSelfLight(const SelfLight& self)
{
    return {
        FindingCode::selfLight,
        fmt::format("light that the object throws on itself was taken out: up to {:.0f} % of a pixel's brightness; it "
                    "explains {:.0f} % of what unlit sides show",
                    100 * self.largestShare, 100 * self.explained)};
}

// Exemplars that won with both lights stay: they know Lambert's law, too, and their reflectance alone is found anew.
ChosenMethod chosenAnew(const ChosenMethod& before, const CaptureSample& direct, const CheckedSample& checked,
                        const Segmentation& materials, NormalOptions options)
{
    if (std::any_of(before.methods.begin(), before.methods.end(),
                    [](NormalMethod method) { return method != NormalMethod::exemplar; })) {
        return chooseMethod(direct, checked, materials, options);
    }
    options.method = NormalMethod::exemplar;
    ChosenMethod chosen = chooseMethod(direct, checked, materials, options);
    std::vector<Finding> findings;
    std::copy_if(before.findings.begin(), before.findings.end(), std::back_inserter(findings), [](const Finding& f) {
        return f.code == FindingCode::methodChosen || f.code == FindingCode::noMethod;
    });
    append(findings, chosen.findings);
    chosen.findings = std::move(findings);
    chosen.heldOutError = before.heldOutError;
    return chosen;
}

} // namespace

ChosenMethod chooseMethod(const PreparedCapture& prepared, const Segmentation& materials, const AcquireOptions& options)
{
    const CaptureSample& sample = prepared.reconciled.sample;
    const NormalMethod asked = options.normals.method;
    ChosenMethod chosen = chooseMethod(sample, prepared.checked, materials, options.normals);
    // Form factors are those of a surface that is seen by a distant camera under distant lights.
    if (prepared.nearField || !options.removeSelfLight ||
        (asked != NormalMethod::automatic && asked != NormalMethod::exemplar)) {
        return chosen;
    }
    const NormalBlock normals = estimateBlock(chosen, materials, sample.seen, sample.lights);
    std::optional<SelfLight> self = findSelfLight(sample.seen, normals.pixels, sample.lights, options.normals.threads);
    if (!self) {
        return chosen;
    }
    CaptureSample direct = sample;
    direct.seen = withoutSelfLight(*self, sample.seen, sample.lights, options.normals.threads);
    chosen = chosenAnew(chosen, direct, prepared.checked, materials, options.normals);
    chosen.findings.push_back(describeSelfLight(*self));
    chosen.self = std::move(self);
    return chosen;
}

void forEachDirect(const PreparedCapture& prepared, const ChosenMethod& chosen, const Observations& block, int threads,
                   const std::function<void(const Observations& direct)>& visit)
{
    if (!chosen.self) {
        visit(block);
        return;
    }
    for (size_t first = 0; first < block.pixels.size(); first += kPixelsPerPart) {
        const size_t last = std::min(block.pixels.size(), first + kPixelsPerPart);
        visit(withoutSelfLight(*chosen.self, rangeOf(block, first, last), prepared.rig.lights, threads));
    }
}

} // namespace nacre
