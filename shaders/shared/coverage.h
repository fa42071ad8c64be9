// Where a table's answer is a guess: how far off f is expected to be, and so a pixel.
#ifndef NACRE_COVERAGE_H
#define NACRE_COVERAGE_H
#include "brdf_coords.h"
NACRE_SHARED_BEGIN

// Uncertain: what is expected to be off by more than this share of itself.
const float kUncertainError = 0.2f;
// The error of what nobody knows.
const float kUnknownError = 2.0f * kUncertainError;
// Covered: a value whose coverage is at least this. Between texels of a table's border coverage falls from 1 to 0.
const float kCoveredConfidence = 0.5f;
// A light on the border of the grid is not beyond it for the rounding of files.
const float kThetaDTolerance = 0.001f; // radians

// Stands in for the expected error where a table tells none: uncertain is what is not covered.
NACRE_FN float errorFromCoverage(float coverage)
{
    return kUnknownError * (1.0f - coverage);
}

// The expected error of f, from the table's own. thetaD of the pair of directions, in radians; tables in natural
// coordinates span all directions.
NACRE_FN float errorWithinTable(float error, float thetaD, int coordinates, float thetaDMax)
{
    bool isWithin = coordinates == kNatural || thetaD <= thetaDMax + kThetaDTolerance;
    return isWithin ? error : max(error, kUnknownError);
}

// Of one light: by how much its radiance may be off beyond what is allowed, in the mean of the channels. Errors of
// lights are taken to go the same way, so that a pixel is uncertain where the sum over its lights is positive.
NACRE_FN float errorBeyondBound(float error, vec3 radiance)
{
    return (error - kUncertainError) * (radiance.x + radiance.y + radiance.z) / 3.0f;
}

NACRE_SHARED_END
#endif
