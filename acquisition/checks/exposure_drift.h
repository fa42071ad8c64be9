#pragma once
#include <optional>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/checks/intensity_refinement.h"

namespace nacre {

// Photographs that are brighter or darker than the irradiances that were measured say, each by its own share, as
// exposures that drift or lamps that warm up make them.
struct ExposureDrift {
    double scatterAsGiven = 0, scatterCorrected = 0; // from Lambert's law, see matte_scatter.h
};

// Where the photographs' own ratios explain matte parts far better than the irradiances as given, and do not go with
// the lights' directions: a reflectance that is not Lambert's, or light that stays on, asks for ratios that do. None
// where there are too few lights to tell, or where they are ill placed.
std::optional<ExposureDrift> findDrift(const PhotographRatios& found, const Observations& sample,
                                       const std::vector<Light>& lights, const NormalOptions& options);

// Multiplies irradiances by the ratios; the remark on it.
Finding correctDrift(const ExposureDrift& drift, const PhotographRatios& found, std::vector<Light>& lights);

} // namespace nacre
