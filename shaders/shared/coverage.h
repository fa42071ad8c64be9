// Where a table's answer is a guess: what was measured is marked by its coverage, and ends at its largest thetaD.
#ifndef NACRE_COVERAGE_H
#define NACRE_COVERAGE_H
#include "brdf_coords.h"
NACRE_SHARED_BEGIN

// Covered: a value whose coverage is at least this. Between texels of a table's border coverage falls from 1 to 0.
const float kCoveredConfidence = 0.5f;
// A light on the border of the grid is not beyond it for the rounding of files.
const float kThetaDTolerance = 0.001f; // radians

// thetaD of the pair of directions, in radians; tables in natural coordinates span all directions.
NACRE_FN bool isMeasured(float coverage, float thetaD, int coordinates, float thetaDMax)
{
    bool isWithin = coordinates == kNatural || thetaD <= thetaDMax + kThetaDTolerance;
    return isWithin && coverage >= kCoveredConfidence;
}

NACRE_SHARED_END
#endif
