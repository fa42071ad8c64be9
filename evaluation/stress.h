#pragma once
#include <string>
#include <vector>

#include "acquisition/acquire.h"
#include "engine/scene/measures.h"
#include "evaluation/normal_sweeps.h"

namespace nacre {

// Whether a program said that its result is not to be trusted.
enum class Said { nothing, warning, refusal };

// One method at one setting of one sweep.
struct StressRow {
    std::string capture, sweep, setting, unit, method;
    AngularError error; // a pixel without a normal counts 90 degrees; all of them where the program refused
    double seconds = 0;
    Said said = Said::nothing;
    double meanConfidence = 0;
    // Share of the pixels that are off by more than kWrongDegrees with more than even confidence and no warning: the
    // user cannot know.
    double silentShare = 0;
};

// Confidence is even where the estimate's own standard error is 5 degrees: twice that is beyond what it claims.
constexpr double kWrongDegrees = 10;
// More of the pixels than this, and the whole is a silent failure.
constexpr double kSilentShare = 0.1;
inline bool isSilentFailure(const StressRow& row)
{
    return row.silentShare > kSilentShare;
}

// The chain as `nacre normals` runs it, from the photographs on. The row's names are the caller's to fill.
StressRow measureNormals(const PhotographedObject& object, NormalMethod method, const AcquireOptions& options);

// Every method at every setting, in this order: sweep, setting, method.
std::vector<StressRow> runSweeps(const std::string& capture, const std::vector<Sweep>& sweeps,
                                 const std::vector<NormalMethod>& methods, const AcquireOptions& options,
                                 const Progress& progress);

} // namespace nacre
