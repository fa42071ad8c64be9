#pragma once
#include <cstdint>

#include "evaluation/held_out/photographed_object.h"

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

// The lights stand at so many object widths from its middle: what each pixel sees comes from a direction of its own and
// falls with the square of the distance (the object's relief, and where highlights move to, are left out).
void bringLightsNear(PhotographedObject& object, double widths);

// The photographs' values, full scale at the largest, are their 1/exponent-th power: encoded, and taken for linear.
// Below 1: decoded, though they were linear.
void bendTransfer(Observations& seen, double exponent);

// As read off a mirror sphere whose centre is off by a share of its radius, upwards and to the right.
void misplaceSphere(std::vector<Light>& lights, double shareOfRadius);

// y downwards where it should point upwards: a flipped green in the normals that follow.
void flipUpwards(std::vector<Light>& lights);

// All of them, in the order in which they happen; as it stands, nothing.
struct Degradation {
    double nearWidths = 0; // 0: distant
    double shadowShare = 0;
    double noise = 0;
    double overexposedShare = 0;
    double transferExponent = 1;
    int bits = 0;           // 0: values as they are
    double sphereShift = 0; // of the mirror sphere; there is a diffuse one as well, which is as it should be
    bool flipped = false;
    double directionErrorDegrees = 0;
    double irradianceError = 0;
    uint64_t seed = 1;
};

PhotographedObject degraded(PhotographedObject object, const Degradation& degradation);

} // namespace nacre
