#include "app/report/plain_verdict.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre {

namespace {

// Of a warning.
const char* reasonOf(FindingCode code)
{
    switch (code) {
    case FindingCode::transferCurveLeft:
    case FindingCode::transferCurveTaken:
        return "the brightness of the files does not follow the light (transfer curve)";
    case FindingCode::offsetLeft:
        return "light that is not the lights' own is left in the photographs";
    case FindingCode::lightsNear:
        return "the lights stood too near";
    case FindingCode::lightsIllPlaced:
        return "the lights do not surround the object";
    case FindingCode::fewLights:
        return "the lights are few";
    case FindingCode::intensitiesUncertain:
        return "how strong each light was is uncertain";
    case FindingCode::spheresDisagree:
        return "the two balls place the lights differently";
    case FindingCode::directionsContradicted:
    case FindingCode::lightsTurned:
    case FindingCode::axesMixed:
        return "the lights' directions do not fit the photographs";
    case FindingCode::maskDark:
    case FindingCode::maskInverted:
    case FindingCode::maskElsewhere:
        return "the mask is missing or does not fit the object";
    case FindingCode::cameraShake:
        return "the camera or the object moved between photographs";
    case FindingCode::photographsAlike:
        return "the photographs hardly differ";
    case FindingCode::normalsUnstable:
        return "other photographs would give other normals";
    case FindingCode::clipped:
        return "much is overexposed";
    case FindingCode::shadowed:
        return "much lies in shadow";
    case FindingCode::notLambertian:
        return "the surface shines, which the method does not allow for";
    case FindingCode::methodsDisagree:
        return "two methods disagree";
    case FindingCode::unexplained:
    case FindingCode::noMethod:
        return "no material that is known shines so";
    default:
        return "";
    }
}

std::vector<std::string> reasonsOf(const NormalEstimate& estimate)
{
    std::vector<std::string> reasons;
    for (const auto* findings : {&estimate.rig.warnings, &estimate.report.findings}) {
        for (const Finding& finding : *findings) {
            const std::string reason = isWarning(finding.code) ? reasonOf(finding.code) : "";
            if (!reason.empty() && std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
                reasons.push_back(reason);
            }
        }
    }
    return reasons;
}

// Empty where it was not measured, as of several materials.
std::string explainedBy(const NormalEstimate& estimate)
{
    for (const CheckFigure& figure : estimate.report.figures) {
        if (figure.code == FindingCode::unexplained) {
            return fmt::format("the normals explain the photographs to {:.0f} % of their brightness",
                               std::max(1.0, 100 * figure.value));
        }
    }
    return "";
}

} // namespace

std::string plainVerdict(const NormalEstimate& estimate)
{
    const std::vector<std::string> reasons = reasonsOf(estimate);
    const std::string explained = explainedBy(estimate);
    if (reasons.empty()) {
        return fmt::format("Good: {}{}no check objects.", explained, explained.empty() ? "" : ", and ");
    }
    return fmt::format("Doubtful: {}{}{}.", explained, explained.empty() ? "" : ", but ", fmt::join(reasons, "; "));
}

} // namespace nacre
