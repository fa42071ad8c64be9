#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/brdf/brdf_table.h"

namespace nacre {

class RglBrdf;

// BRDFs, parametric and measured: f(n, l, v) in 1/sr per channel without the cosine, 0 below either horizon.

struct LambertGgx {
    glm::vec3 diffuse{0.5f};   // albedo; f = diffuse / pi
    glm::vec3 specular{0.04f}; // Schlick's F0
    float alpha = 0.3f;        // GGX roughness
};

// Loew et al., Microfacet Models for Reflection from Rough Surfaces (ABC), 2012, as fitted to MERL: data/README.md.
struct AbcModel {
    glm::vec3 kD;
    glm::vec3 A;
    float B;
    float C;
    float ior;
};

// Bagher, Soler, Holzschuch, Accurate fitting of measured reflectances using a Shifted Gamma micro-facet distribution,
// 2012.
struct SgdModel {
    glm::vec3 rhoD, rhoS, alpha, p, F0, F1, kap, lambda, c, k, theta0;
};

using BrdfModel =
    std::variant<LambertGgx, AbcModel, SgdModel, std::shared_ptr<const BrdfTable>, std::shared_ptr<const RglBrdf>>;

glm::vec3 evaluate(const BrdfModel& model, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// The same with its coverage: 0 below either horizon and beyond a table's domain, within it the table's confidence;
// 1 everywhere else.
BrdfValue evaluateCovered(const BrdfModel& model, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// The table that the model is; null for the others.
const BrdfTable* tableOf(const BrdfModel& model);

struct NamedBrdf {
    std::string name;
    BrdfModel model;
};

// The published fits, one a row (merl_abc_params.csv, merl_sgd_params.csv).
std::vector<NamedBrdf> loadAbcFits(const std::filesystem::path& csv);
std::vector<NamedBrdf> loadSgdFits(const std::filesystem::path& csv);

} // namespace nacre
