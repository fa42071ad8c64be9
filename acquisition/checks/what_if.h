#pragma once
#include <optional>

#include "acquisition/capture/finding.h"
#include "acquisition/capture/observations.h"
#include "acquisition/checks/matte_scatter.h"
#include "acquisition/near_field/near_field.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// A defect of the whole capture that, once undone, lets Lambert's law explain the matte observations far better.
struct CaptureDefect {
    enum class Kind { encoded, decoded, nearLights };
    Kind kind = Kind::encoded;
    double size = 0;    // the exponent that undoes it; the distance of the lights in widths of the object
    double scatter = 0; // that is left, see matte_scatter.h
};

// matteScatter of what is seen where lights and camera stand as `near` says, by consensus in a few steps, since a
// normal has to be known for its own light to be exchanged for the distant one. `height`: see LocalLights.
double scatterAtDistance(const Observations& seen, const std::vector<Light>& lights, const NearField& near,
                         const Image& height, const NormalEstimator& consensus, const MatteChoice& matte);

// Of photographs that are known to be good there is less.
bool isLambertian(double scatter);

// Whether the scatter that another transfer curve leaves is so much less that it has to be the right one. What even
// then is far from Lambert's law tells nothing.
bool tellsCurve(double scatter, double scatterAsTaken);

// Tries transfer curves (powers of the photographs' values) and finite distances of the lights, on a few hundred pixels
// of the object, and answers what explains best, if that is far better than taking the capture as it is. `width`: of
// the grid that seen.pixels count in; 0 where it is not known. `scatter`: of the capture as it is.
struct DefectSearch {
    std::optional<CaptureDefect> defect;
    std::vector<CheckFigure> figures; // by kind, the largest share of the scatter that a trial undoes
};
DefectSearch findDefect(const Observations& seen, const std::vector<Light>& lights, const NormalOptions& options,
                        double scatter);

} // namespace nacre
