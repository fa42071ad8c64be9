#pragma once
#include <string>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/checks/intensity_refinement.h"

namespace nacre {

// A photograph that no intensity reconciles with the others: another object's, a moved or blurred one, one whose
// direction is wrong, a black one.
struct DiscordantPhotograph {
    size_t index = 0;
    PhotographScatter scatter;
};

// Those whose pixels scatter far more than the other photographs' own (by the median and the robust spread of all
// scatters, so that an object that is not Lambert's condemns no photograph), or that are dark where the object faces
// their light. Empty where the photographs left would be too few to tell, or would not span space.
std::vector<DiscordantPhotograph> findDiscordant(const PhotographRatios& ratios, const std::vector<Light>& lights);

// A remark for the user: names, figures, and what is usual here.
Finding describeDiscordant(const std::vector<DiscordantPhotograph>& discordant, const PhotographRatios& ratios,
                           const std::vector<std::string>& names);

} // namespace nacre
