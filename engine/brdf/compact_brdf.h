#pragma once
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_table.h"
#include "engine/brdf/texel_format.h"

namespace nacre {

// Smaller descriptions of a material than its full table, each enough to make a table from (expandedTable).

// f = kD / pi + a lobe; A = 0: Lambert.
struct FittedLobe {
    AbcModel model;
};

// A table of fewer texels, or of shorter ones; size.z = 1: bivariate, f(thetaH, thetaD). Holds quantised values.
struct SmallTable {
    BrdfTable table;
    TexelFormat format = TexelFormat::rgba32f;
};

// Functions on a table's grid, of which the colour channels of several materials are combinations.
struct BrdfBasis {
    glm::ivec3 size{0};
    TableDomain domain{kHalfDifference, kHalfPi};
    int rank = 0;
    std::vector<float> components; // [r * texels + texel], values that a 16-bit float holds
};

// f of a channel = sum over r of coefficients[r](channel) component r.
struct BasisBrdf {
    std::shared_ptr<const BrdfBasis> basis;
    std::vector<float> coefficients; // [r * 3 + channel]
};

using CompactBrdf = std::variant<FittedLobe, SmallTable, BasisBrdf>;

// "Lambert", "Lambert + lobe", "bivariate", "table", "3 components".
std::string nameOf(const CompactBrdf& model);
// The same with the table's size and format, where it has one: "table 64x12x12 RGBA16F".
std::string describe(const CompactBrdf& model);
// Of what it takes in memory, a basis included; coverage apart.
size_t bytesOf(const CompactBrdf& model);
size_t bytesOf(const BrdfBasis& basis);

// The table that the renderer looks up, with the coverage of `covered`, sampled where grids differ: a small table as it
// is, the others on covered's grid. f is never negative.
BrdfTable expandedTable(const CompactBrdf& model, const BrdfTable& covered);

// `table` on another grid, trilinear; domains differ in thetaDMax alone. What lies beyond the table's own range has its
// border's values and confidence 0.
BrdfTable resampledTable(const BrdfTable& table, const glm::ivec3& size, const TableDomain& domain);

} // namespace nacre
