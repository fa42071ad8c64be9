#pragma once
#include <string>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/checks/facing_ratios.h"

namespace nacre {

// How each photograph stands to the others: the median over its lit pixels of observation to prediction, per channel.
struct PhotographRatios {
    std::vector<glm::vec3> ratios; // per light; 1 = as predicted. Their median over the lights is 1 in each channel
    float spread = 0;              // robust standard deviation of their logarithms
    std::vector<PhotographScatter> scatters; // per light
    int iterations = 0;
    bool settled = false; // else the ratios are 1 and the scatters those of the irradiances as they were given
};

constexpr int kMostIterations = 60;
// Lights whose condition is larger tell a tilt of the object from a slope of their intensities by their curvature
// alone.
constexpr double kWorstTellingCondition = 5;

// Normals by consensus on the sample, ratios of observation to Lambertian prediction, irradiances times the ratios, and
// again until they rest (semi-calibrated photometric stereo: Cho, Matsushita, Tai and Kweon, Photometric Stereo Under
// Non-uniform Light Intensities and Exposures, 2016, with medians). Close to rest by Newton's steps, since a slope of
// the intensities that tilts the object leaves ratios near 1 where lights are ill placed. What the photographs tell by
// less than their own scatter is drawn to equal ratios, all the more the worse the lights are placed and the less the
// ratios differ otherwise. `lights` stay as they are; the ratios tell.
PhotographRatios estimateIntensityRatios(const Observations& sample, const std::vector<Light>& lights,
                                         const NormalOptions& options, int mostIterations = kMostIterations);

// For irradiances that were measured: photographs whose ratios disagree are asked again with all others at 1. Few
// lights leave room to explain one bad photograph by the strength of another, which does not hold once the others hold
// still.
PhotographRatios confirmedRatios(const PhotographRatios& found, const Observations& sample,
                                 const std::vector<Light>& lights, const NormalOptions& options);

// Whether there are enough photographs and pixels to compare them.
bool canCompare(const Observations& sample);

// Multiplies irradiances by the ratios: of every light where irradiances are not `known`, else of the photographs that
// disagree with the rest. Answers a remark for each, by the photographs' names, and a warning where intensities did not
// settle, or nobody gave them for lights that are ill placed.
std::vector<Finding> correctIntensities(const PhotographRatios& found, const std::vector<std::string>& names,
                                        bool known, std::vector<Light>& lights);

} // namespace nacre
