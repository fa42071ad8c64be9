#include "acquisition/capture/finding.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

// In the order of FindingCode.
constexpr std::array<std::string_view, 34> kNames = {"transfer-curve-left",
                                                     "transfer-curve-taken",
                                                     "offset-left",
                                                     "lights-near",
                                                     "lights-ill-placed",
                                                     "few-lights",
                                                     "intensities-uncertain",
                                                     "spheres-disagree",
                                                     "directions-contradicted",
                                                     "lights-turned",
                                                     "axes-mixed",
                                                     "mask-dark",
                                                     "mask-inverted",
                                                     "mask-elsewhere",
                                                     "camera-shake",
                                                     "photographs-alike",
                                                     "normals-unstable",
                                                     "clipped",
                                                     "shadowed",
                                                     "not-lambertian",
                                                     "methods-disagree",
                                                     "unexplained",
                                                     "no-method",
                                                     "lights-placed",
                                                     "photographs-left-out",
                                                     "values-end",
                                                     "hollow",
                                                     "intensities-estimated",
                                                     "intensities-corrected",
                                                     "method-chosen",
                                                     "reflectance-chosen",
                                                     "one-albedo",
                                                     "not-reciprocal",
                                                     "self-light"};
static_assert(kNames.size() == static_cast<size_t>(FindingCode::selfLight) + 1);

} // namespace

std::string_view nameOf(FindingCode code)
{
    return kNames[static_cast<size_t>(code)];
}

bool isWarning(FindingCode code)
{
    return code <= FindingCode::noMethod;
}

std::string lineOf(const Finding& finding)
{
    return (isWarning(finding.code) ? "warning: " : "") + finding.text;
}

void SelfChecks::judge(FindingCode code, double value, double limit, const std::string& text)
{
    figures.push_back({code, value, limit});
    if (value > limit) {
        findings.push_back({code, text});
    }
}

void SelfChecks::add(const SelfChecks& more)
{
    append(findings, more.findings);
    figures.insert(figures.end(), more.figures.begin(), more.figures.end());
}

bool contains(const std::vector<Finding>& findings, FindingCode code)
{
    return std::any_of(findings.begin(), findings.end(), [code](const Finding& f) { return f.code == code; });
}

void append(std::vector<Finding>& to, const std::vector<Finding>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

} // namespace nacre
