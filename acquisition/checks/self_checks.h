#pragma once
#include <optional>
#include <string>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/capture/observations.h"
#include "acquisition/checks/what_if.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// A few hundred pixels of an object, by which a capture is checked against itself.
struct CheckedSample {
    Observations seen;
    Intensities intensities;
    std::vector<Light> lights;
    NormalBlock consensus;
    double scatter = 0; // from Lambert's law, see matte_scatter.h
    double instability = 0;
    std::optional<CaptureDefect> defect;
    SelfChecks checks;
};

// How far a few hundred pixels of an object are from Lambert's law by consensus, see matte_scatter.h; 0 where there are
// too few to tell.
double lambertScatter(const Observations& sample, const std::vector<Light>& lights, const NormalOptions& options);

// Each finding names what is likely wrong with the photographs or lights, and what to do; docs/limitations.md lists
// them.
CheckedSample checkCapture(const Observations& sample, const std::vector<Light>& lights, const NormalOptions& options);

// What is to be said of a method's normals, once it is known which method was taken.
SelfChecks checkMethod(const CheckedSample& sample, NormalMethod method, const NormalEstimator& estimator);

} // namespace nacre
