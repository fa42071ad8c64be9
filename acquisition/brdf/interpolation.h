#pragma once
#include <functional>
#include <string>

#include "acquisition/brdf/brdf_samples.h"

namespace nacre {

// paper: Wu et al., kernel_regression.h. localLinear: local_linear.h.
enum class InterpolationMethod { localLinear, paper };

// "local-linear", "paper"; a usage Error lists the names.
InterpolationMethod interpolationMethodFromName(const std::string& name);
std::string nameOf(InterpolationMethod method);

struct InterpolationOptions {
    InterpolationMethod method = InterpolationMethod::localLinear;
    int k = 25;             // neighbours, 1 to kMostNeighbours
    SampleMetric metric{};  // local-linear
    bool automatic = false; // k and metric by held-out samples, see interpolation_choice.h
    bool completed = false; // local-linear in half-difference coordinates: by a prior over materials, see completion.h
    int threads = 0;
};

inline constexpr int kMostNeighbours = 512;

struct InterpolatedValue {
    glm::vec3 value{0};
    float nearest = 0; // radians to the nearest sample
    float error = 0;   // expected, relative (BrdfTable); 0 where nobody tells
};

// f at unit coordinates of the samples' domain; beyond the samples it is extrapolated, and `nearest` says how far.
using BrdfInterpolant = std::function<InterpolatedValue(const glm::vec3& unit)>;

// What does not depend on the query is done here. Throws Error where there is no sample (data) or k is out of range
// (usage). The interpolant holds what it needs of the samples.
BrdfInterpolant makeInterpolant(const BrdfSamples& samples, const InterpolationOptions& options);

} // namespace nacre
