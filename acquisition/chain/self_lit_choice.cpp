#include "acquisition/chain/self_lit_choice.h"

#include <utility>

#include <fmt/format.h>

namespace nacre {

namespace {

Finding describeSelfLight(const SelfLight& self)
{
    return {
        FindingCode::selfLight,
        fmt::format("light that the object throws on itself was taken out: up to {:.0f} % of a pixel's brightness; it "
                    "explains {:.0f} % of what unlit sides show",
                    100 * self.largestShare, 100 * self.explained)};
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
    chosen = chooseMethod(direct, prepared.checked, materials, options.normals);
    chosen.findings.push_back(describeSelfLight(*self));
    chosen.self = std::move(self);
    return chosen;
}

const Observations& directLight(const PreparedCapture& prepared, const ChosenMethod& chosen, const Observations& block,
                                int threads, Observations& direct)
{
    if (!chosen.self) {
        return block;
    }
    direct = withoutSelfLight(*chosen.self, block, prepared.rig.lights, threads);
    return direct;
}

} // namespace nacre
