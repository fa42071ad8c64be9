#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/block_walk.h"
#include "engine/files/measures.h"
#include "evaluation/stress/normal_sweeps.h"

namespace nacre {

// Whether a program said that its result is not to be trusted.
enum class Said { nothing, warning, refusal };

// One method at one setting of one sweep.
struct StressRow {
    std::string capture, sweep, setting, unit;
    std::string method; // of normals; "brdf-" and the interpolation for a BRDF by the normals of `auto`
    bool isBrdf = false;
    // Normals: mean degrees, a pixel without one counting 90, all of them where the program refused. BRDF: % of the
    // radiance, over the lit observations.
    double error = 0;
    AngularError angles; // of normals
    double seconds = 0;
    Said said = Said::nothing;
    std::string warnings; // what it said
    double meanConfidence = 0;
    // Share of the pixels that are off by more than kWrongDegrees with more than even confidence.
    double wrongShare = 0;
    bool broken = false; // see judgeRows
};

// Confidence is even where the estimate's own standard error is 5 degrees: twice that is beyond what it claims.
constexpr double kWrongDegrees = 10;
// More of the pixels than this, and the estimate claims more than it knows, however bad it was from the start.
constexpr double kWrongShare = 0.1;

inline bool isSilentFailure(const StressRow& row)
{
    return row.broken && row.said == Said::nothing;
}
inline bool isOverconfident(const StressRow& row)
{
    return !row.broken && row.wrongShare > kWrongShare && row.said == Said::nothing;
}
inline bool isFalseAlarm(const StressRow& row)
{
    return !row.broken && row.said != Said::nothing;
}

// Errors below which none is told from another.
struct StressFloors {
    double degrees = 0;
    double percent = 0;
};

// Normals: what an error of 1 % in the photographs, which few are below, makes of normals at worst through the
// capture's own lights. BRDF: kLeastTolerance, within which an observation counts as explained.
StressFloors floorsOf(const std::vector<Light>& lights);

// Tells which rows are broken: those whose error is twice that of their method at the sweep's first setting, or twice
// the floor where that is larger.
void judgeRows(std::vector<StressRow>& rows, const StressFloors& floors);

// The chain as `nacre normals` runs it, from the photographs on. The row's names are the caller's to fill.
StressRow measureNormals(const PhotographedObject& object, NormalMethod method, const AcquireOptions& options);

// Every method at every setting, in this order: sweep, setting, method; with `auto` among them, a row for each
// interpolation of the BRDF follows it.
std::vector<StressRow> runSweeps(const StressSubject& subject, const std::vector<Sweep>& sweeps,
                                 const std::vector<NormalMethod>& methods, const AcquireOptions& options,
                                 const Progress& progress);

} // namespace nacre
