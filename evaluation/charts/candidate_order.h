#pragma once
#include <string>
#include <vector>

#include "evaluation/charts/chart_settings.h"

namespace nacre {

// One way through the whole chain that --budget-time may try.
struct AcquireCandidate {
    NormalMethod method = NormalMethod::automatic;
    size_t lightsGiven = 0; // 0: all
    InterpolationMethod interpolation = InterpolationMethod::localLinear;
    int k = 25;
    glm::ivec3 tableSize{0}; // 0: from the captured range
    double seconds = 1;      // what normals and tables took in the charts: it orders, and predicts by ratio
};

// From the quickest to the most accurate, as charts of several captures have them: candidate_order.inc, which
// `nacre chart ... --write-order` makes. Only an order; whether a candidate is any good is measured on the capture.
std::vector<AcquireCandidate> candidateOrder();

// The front of all settings of normals and BRDF together: seconds against error, both by their ratios within a
// capture, the geometric mean over captures. Of candidates within a tenth of the time the best is taken, and one
// that gains less than 3 % on the one before is left out. Throws Error (usage) where the rows lack either part.
std::vector<AcquireCandidate> candidatesFrom(const ChartRows& rows);

// candidate_order.inc: a line of C++ a candidate.
std::string sourceOf(const std::vector<AcquireCandidate>& candidates);

AcquireOptions optionsOf(const AcquireCandidate& candidate, AcquireOptions options);

// As options of `nacre acquire`, which give the same surface.
std::string commandLineOf(const AcquireCandidate& candidate);

} // namespace nacre
