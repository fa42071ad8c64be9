#pragma once
#include <string>
#include <vector>

#include "acquisition/exemplar/exemplar_match.h"
#include "acquisition/normals/intensities.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// A reflectance as matching uses it.
struct Exemplar {
    std::string name;
    PredictedBall coarse; // for the first, wide search; empty in exemplars that only refine
    PredictedBall fine;
    ScaleRange scales;
};

// What explains one object under one set of lights.
struct ExemplarModel {
    float cosRadius = 0;               // of the wide search around the consensus normal
    std::vector<Exemplar> exemplars;   // the known reflectances that explain the object best, best first
    std::vector<Exemplar> reestimated; // then, in turn, the object's own BRDF as each round found it
};

// The one whose predictions count.
inline const Exemplar& lastExemplar(const ExemplarModel& model)
{
    return model.reestimated.empty() ? model.exemplars.front() : model.reestimated.back();
}

// Normals and scales of a block's pixels; scale 0 where nothing matched.
struct ExemplarResult {
    std::vector<glm::vec3> normals;
    std::vector<float> scales;
};

// `weights`: per light, padded like the intensities; 0 leaves a light out.
ExemplarResult matchBlock(const ExemplarModel& model, const Intensities& intensities,
                          const std::vector<glm::vec3>& starts, const std::vector<float>& weights, int threads);

// One more round: the normals and scales that `own` gives next to those of the round before.
void refineBlock(const Exemplar& own, const Intensities& intensities, const std::vector<float>& weights, int threads,
                 ExemplarResult& result);

// The mean truncated cost of the model's predictions for the lights of `judged`, with normals and scales as given.
double predictionCost(const Exemplar& exemplar, const Intensities& intensities, const ExemplarResult& result,
                      const std::vector<float>& judged);

// Chooses the reflectances, then re-estimates with the object's own BRDF while the error on held-out lights falls.
// Findings say what was chosen.
ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<glm::vec3>& starts,
                                const std::vector<Light>& lights, const NormalOptions& options,
                                std::vector<Finding>& findings);

// A pixel to be matched; its residuals are truncated at a share of its own bright level.
MatchTarget targetOf(const Intensities& intensities, size_t pixel, const std::vector<float>& weights);

} // namespace nacre
