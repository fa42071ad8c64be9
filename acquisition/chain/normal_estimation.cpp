#include "acquisition/chain/normal_estimation.h"
#include "acquisition/chain/curve_choice.h"

#include <algorithm>
#include <span>
#include <utility>

#include "acquisition/checks/height_consistency.h"
#include "acquisition/normals/smooth_fill.h"

namespace nacre {

namespace {

constexpr int kFewestLit = 3; // lights that a normal and an albedo take

// No normals, so no samples, from pixels that are to be smoothed over.
void dropMarked(const Capture& capture, const Observations& block, NormalBlock& normals)
{
    for (size_t p = 0; p < block.pixels.size() && !capture.smooth.empty(); ++p) {
        if (capture.smooth[block.pixels[p]]) {
            normals.pixels[p] = PixelNormal{};
        }
    }
}

// A curve that was taken from linear files is told by photographs that nacre itself decoded, or that are far from
// Lambert's law: matter whose shading falls faster than the cosine looks the same.
std::vector<Finding> believable(const CheckedSample& checked, const Capture& capture)
{
    std::vector<Finding> findings = checked.checks.findings;
    if (capture.curve == TransferCurve::linear && isLambertian(checked.scatter)) {
        std::erase_if(findings, [](const Finding& f) { return f.code == FindingCode::transferCurveTaken; });
    }
    return findings;
}

} // namespace

LocalLights PreparedCapture::localLights() const
{
    return nearField ? LocalLights(rig.lights, *nearField, guess.height, blocks.capture().width) : rig.lights;
}

NormalEstimate startEstimate(const PreparedCapture& prepared, const ChosenMethod& chosen)
{
    NormalEstimate estimate;
    estimate.given = prepared.given;
    estimate.rig = prepared.rig;
    estimate.nearField = prepared.nearField;
    estimate.leftOut = prepared.reconciled.leftOut;
    estimate.report = {chosen.method, prepared.reconciled.findings, prepared.reconciled.figures, chosen.heldOutError,
                       prepared.lambertianMisfit};
    append(estimate.report.findings, warningsOf(prepared.rig.lights));
    append(estimate.report.findings, prepared.placed);
    append(estimate.report.findings, believable(prepared.checked, prepared.blocks.capture()));
    append(estimate.report.findings, chosen.findings);
    for (const auto* figures : {&prepared.checked.checks.figures, &chosen.figures}) {
        estimate.report.figures.insert(estimate.report.figures.end(), figures->begin(), figures->end());
    }
    nameAssumedCurve(prepared.blocks.capture(), estimate.report.findings);
    estimate.normals = NormalMap(prepared.blocks.capture().width, prepared.blocks.capture().height);
    estimate.verdicts.resize(prepared.rig.lights.size());
    return estimate;
}

NormalBlock estimateNormals(const PreparedCapture& prepared, const ChosenMethod& chosen, const Segmentation& materials,
                            const Observations& block)
{
    if (!prepared.nearField) {
        NormalBlock normals = estimateBlock(chosen, materials, block, prepared.rig.lights);
        dropMarked(prepared.blocks.capture(), block, normals);
        return normals;
    }
    const LocalLights local = prepared.localLights();
    const Observations distant =
        asIfDistant(block, local, localNormals(block, local, prepared.guess.normals), prepared.threads);
    NormalBlock normals = estimateBlock(chosen, materials, distant, prepared.rig.lights);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        normals.pixels[p].normal = local.toCamera(block.pixels[p], normals.pixels[p].normal);
    }
    dropMarked(prepared.blocks.capture(), block, normals);
    return normals;
}

void storeNormals(const Observations& block, const NormalBlock& normals, bool keepVerdicts, NormalEstimate& estimate)
{
    const size_t n = block.lightCount;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = normals.pixels[p];
        estimate.normals.normals[block.pixels[p]] = pixel.confidence > 0 ? pixel.normal : glm::vec3(0);
        estimate.normals.confidence[block.pixels[p]] = pixel.confidence;
        const auto verdicts = std::span(normals.verdicts).subspan(p * n, n);
        estimate.pixelsWithoutNormal += pixel.confidence <= 0;
        estimate.pixelsInShade += std::count(verdicts.begin(), verdicts.end(), Verdict::used) < kFewestLit;
        for (size_t i = 0; i < n; ++i) {
            VerdictCounts& counts = estimate.verdicts[i];
            switch (normals.verdicts[p * n + i]) {
            case Verdict::used:
                ++counts.used;
                break;
            case Verdict::shadow:
                ++counts.shadow;
                break;
            case Verdict::highlight:
                ++counts.highlight;
                break;
            case Verdict::saturated:
                ++counts.saturated;
                break;
            }
        }
    }
    if (keepVerdicts) {
        estimate.pixels.insert(estimate.pixels.end(), block.pixels.begin(), block.pixels.end());
        estimate.everyVerdict.insert(estimate.everyVerdict.end(), normals.verdicts.begin(), normals.verdicts.end());
    }
}

void finishEstimate(const Capture& capture, NormalEstimate& estimate)
{
    const SelfChecks height = checkHeight(estimate.normals);
    append(estimate.report.findings, height.findings);
    estimate.report.figures.insert(estimate.report.figures.end(), height.figures.begin(), height.figures.end());
    if (!capture.smooth.empty()) {
        estimate.pixelsSmoothed = fillSmoothly(estimate.normals, capture.smooth, capture.mask);
        estimate.pixelsWithoutNormal -= estimate.pixelsSmoothed;
    }
}

} // namespace nacre
