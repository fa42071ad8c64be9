#include "acquisition/chain/curve_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/chain/capture_preparation.h"
#include "acquisition/checks/self_checks.h"

namespace nacre {

namespace {

// Relative differences of decoded values are about as many times those of the codes.
constexpr double kSrgbPower = 2.2;

double scatterBy(Capture capture, const TransferCurve& curve, const AcquireOptions& options)
{
    capture.curve = curve;
    StageClock clock;
    const PreparedCapture prepared = reconcileCapture(capture, options, clock, [](const std::string&, double) {}).first;
    const CaptureSample& sample = prepared.reconciled.sample;
    return lambertScatter(sample.seen, sample.lights, options.normals) /
           (curve == TransferCurve::srgb ? kSrgbPower : 1);
}

} // namespace

Capture withToldCurve(const Capture& capture, const AcquireOptions& options)
{
    if (!capture.curveIsAssumed || (capture.lights.empty() && !capture.mirrorSphere)) {
        return capture;
    }
    const bool isLinear = capture.curve == TransferCurve::linear;
    const TransferCurve& other = isLinear ? TransferCurve::srgb : TransferCurve::linear;
    const double assumed = scatterBy(capture, capture.curve, options), changed = scatterBy(capture, other, options);
    if (!tellsCurve(changed, assumed)) {
        return capture;
    }
    Capture told = capture;
    told.curve = other;
    told.curveIsAssumed = false;
    told.curveSource = fmt::format("the files declare none; Lambert's law misses matte parts by {:.2f} %, by {:.2f} % "
                                   "were they {}",
                                   100 * changed, 100 * assumed, capture.curve.name);
    return told;
}

void nameAssumedCurve(const Capture& capture, std::vector<Finding>& findings)
{
    constexpr FindingCode kByCurve[] = {FindingCode::transferCurveLeft,
                                        FindingCode::transferCurveTaken,
                                        FindingCode::lightsNear,
                                        FindingCode::spheresDisagree,
                                        FindingCode::directionsContradicted,
                                        FindingCode::lightsTurned,
                                        FindingCode::axesMixed,
                                        FindingCode::normalsUnstable,
                                        FindingCode::notLambertian,
                                        FindingCode::methodsDisagree,
                                        FindingCode::unexplained,
                                        FindingCode::noMethod};
    if (!capture.curveIsAssumed) {
        return;
    }
    for (Finding& finding : findings) {
        if (std::find(std::begin(kByCurve), std::end(kByCurve), finding.code) != std::end(kByCurve)) {
            finding.text = fmt::format(
                "--transfer {} first, as the files declare no curve and are taken for {}; else: {}",
                capture.curve == TransferCurve::linear ? "srgb" : "linear", capture.curve.name, finding.text);
        }
    }
}

} // namespace nacre
