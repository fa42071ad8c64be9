#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

// What a stage tells the user beside its result. JSON, docs/limitations.md and tests match codes, not texts.
enum class FindingCode {
    // Warnings: the result may be wrong.
    transferCurveLeft,
    transferCurveTaken,
    offsetLeft,
    lightsNear,
    lightsIllPlaced,
    fewLights,
    intensitiesUncertain,
    spheresDisagree,
    directionsContradicted,
    lightsTurned,
    axesMixed,
    maskDark,
    maskInverted,
    maskElsewhere,
    cameraShake,
    photographsAlike,
    normalsUnstable,
    clipped,
    shadowed,
    notLambertian,
    methodsDisagree,
    unexplained,
    noMethod,
    // Remarks: what was done.
    lightsPlaced,
    photographsLeftOut,
    valuesEnd,
    hollow,
    intensitiesEstimated,
    intensitiesCorrected,
    methodChosen,
    reflectanceChosen,
    oneAlbedo,
    notReciprocal,
    selfLight,
};

struct Finding {
    FindingCode code;
    std::string text; // one line, without the code
    bool operator==(const Finding&) const = default;
};

// "transfer-curve-left", "lights-near", ...
std::string_view nameOf(FindingCode code);
bool isWarning(FindingCode code);

// The text; of a warning with "warning: " before it.
std::string lineOf(const Finding& finding);

// What a self-check measured; above its limit it is a finding.
struct CheckFigure {
    FindingCode code;
    double value = 0;
    double limit = 0;
};

struct SelfChecks {
    std::vector<Finding> findings;
    std::vector<CheckFigure> figures;

    void judge(FindingCode code, double value, double limit, const std::string& text);
    void add(const SelfChecks& more);
};

bool contains(const std::vector<Finding>& findings, FindingCode code);
void append(std::vector<Finding>& to, const std::vector<Finding>& more);

} // namespace nacre
