#pragma once
#include <cstdint>

#include "evaluation/photographed_object.h"

namespace nacre {

// What goes wrong when photographs are taken, or when their lights are written down. Each function does one thing, by
// a seed that makes it the same again.

// Something stands before `share` of every pixel's lights: those nearest to a light that is drawn per pixel go dark.
void castShadows(Observations& seen, const std::vector<Light>& lights, double share, uint64_t seed);

// Normal noise, its standard deviation as a share of the 99th percentile of all values.
void addNoise(Observations& seen, double share, uint64_t seed);

// Full scale is where `share` of all values are larger: they are cut there, and their observations marked saturated.
void overexpose(Observations& seen, double share);

// Integers of so many bits, full scale at the largest value. What is below 0 is 0.
void quantise(Observations& seen, int bits);

// Every direction is off by just so many degrees, to a side of its own.
void turnDirections(std::vector<Light>& lights, double degrees, uint64_t seed);

// Irradiances are off by a factor each, whose logarithm has this standard deviation; the same for all channels.
void misjudgeIrradiances(std::vector<Light>& lights, double deviation, uint64_t seed);

// All of them, in the order in which they happen; as it stands, nothing.
struct Degradation {
    double shadowShare = 0;
    double noise = 0;
    double overexposedShare = 0;
    int bits = 0; // 0: values as they are
    double directionErrorDegrees = 0;
    double irradianceError = 0;
    uint64_t seed = 1;
};

PhotographedObject degraded(PhotographedObject object, const Degradation& degradation);

} // namespace nacre
