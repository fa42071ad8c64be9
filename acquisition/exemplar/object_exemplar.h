#pragma once
#include <optional>

#include "acquisition/exemplar/exemplar_model.h"
#include "engine/brdf/brdf_table.h"

namespace nacre {

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

} // namespace nacre
