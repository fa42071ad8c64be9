#pragma once
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

using CompactBrdf = std::variant<FittedLobe, SmallTable>;

// "Lambert", "Lambert + lobe", "bivariate", "table".
std::string nameOf(const CompactBrdf& model);
// The same with the table's size and format, where it has one: "table 64x12x12 RGBA16F".
std::string describe(const CompactBrdf& model);
// Of what it takes in memory, coverage apart.
size_t bytesOf(const CompactBrdf& model);

// The table that the renderer looks up, with the coverage of `covered`: a small table as it is, a lobe on covered's
// grid. f is never negative.
BrdfTable expandedTable(const CompactBrdf& model, const BrdfTable& covered);

// `table` on another grid, trilinear; domains differ in thetaDMax alone. What lies beyond the table's own range has its
// border's values and confidence 0.
BrdfTable resampledTable(const BrdfTable& table, const glm::ivec3& size, const TableDomain& domain);

} // namespace nacre
