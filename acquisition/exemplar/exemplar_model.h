#pragma once
#include <optional>
#include <string>
#include <vector>

#include "acquisition/exemplar/exemplar_match.h"
#include "acquisition/normals/intensities.h"
#include "acquisition/normals/normals.h"
#include "engine/brdf/brdf_table.h"

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

constexpr int kFineBallSize = 96; // texels across: 1.2 degrees in the middle

// Every sixth light is left out where a choice is judged by the lights that it did not see.
constexpr bool isHeldOut(size_t light)
{
    return light % 6 == 3;
}

// Weights 1 for every light, padded with zeros.
std::vector<float> allLights(size_t count);
size_t countOf(const std::vector<float>& weights);

// Verdicts on a block's observations by what the exemplar predicts for its normals and scales.
std::vector<Verdict> judgeByExemplar(const Exemplar& exemplar, const Intensities& intensities,
                                     const ExemplarResult& result, int threads);

// The object's own BRDF, grey, up to its common scale: baked from the observations that have weight and are not in
// shadow, with the normals and scales as given. Nothing where no observation is left.
std::optional<BrdfTable> makeObjectTable(const Intensities& sample, const ExemplarResult& result,
                                         const std::vector<Verdict>& verdicts, const std::vector<Light>& lights,
                                         const std::vector<float>& weights, int threads);

// The table as an exemplar to match pixels with.
Exemplar makeObjectExemplar(const BrdfTable& table, const std::vector<Light>& lights, int threads);

// The table carries the object's common scale: a pixel's own is its albedo, around 1.
constexpr ScaleRange kOwnScales{0.5f, 2.0f};

// Adds rounds of the object's own BRDF, baked from the sample's lit observations with the normals of the round before,
// as long as that predicts held-out lights better than the round before.
void reestimate(ExemplarModel& model, const Intensities& sample, const std::vector<glm::vec3>& starts,
                const std::vector<Light>& lights, int threads, std::vector<Finding>& findings);

// Photometric stereo by virtual exemplars: after Hertzmann and Seitz, Shape and Materials by Example, 2003, and Hui and
// Sankaranarayanan, Shape and Spatially-Varying Reflectance Estimation from Virtual Exemplars, 2017, with a residual
// that forgets cast shadows and a start from the triple consensus. `sample`: pixels from all over the object.
NormalEstimator makeExemplarEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                      const NormalOptions& options, std::vector<Finding>& findings);

} // namespace nacre
