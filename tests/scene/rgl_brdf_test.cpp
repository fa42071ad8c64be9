#include "engine/brdf/rgl_brdf.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "engine/brdf/brdf_comparison.h"
#include "engine/brdf/brdf_tabulation.h"
#include "tests/support/data_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/models_as_tables.h"
#include "tests/support/temp_folder.h"
#include "tests/support/tensor_file.h"

namespace nacre {
namespace {

const std::vector<std::string> kMaterials{"paper_white", "colodur_napoli_4f", "vch_golden_yellow"};

std::filesystem::path fileOf(const std::string& material)
{
    return dataFolder() / "measured" / (material + "_rgb.bsdf");
}

struct Truth {
    std::vector<LightView> directions;
    std::vector<glm::vec3> values;
};

// Columns: thetaH, thetaD, phiD, l, v, f.
Truth loadTruth(const std::string& material)
{
    std::ifstream stream(dataFolder() / "measured" / ("truth_" + material + "_rgb.csv"));
    Truth truth;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        glm::vec3 angles, l, v, f;
        for (glm::vec3* column : {&angles, &l, &v, &f}) {
            words >> column->x >> column->y >> column->z;
        }
        truth.directions.push_back({glm::normalize(l), glm::normalize(v)});
        truth.values.push_back(f);
    }
    return truth;
}

template <class F> BrdfComparison compareToTruth(const Truth& truth, F&& f)
{
    std::vector<glm::vec3> values;
    for (const LightView& d : truth.directions) {
        values.push_back(f(d.l, d.v));
    }
    return compareValues(values, truth.values);
}

TEST(RglBrdf, AgreesWithTheDatabasesOwnCode)
{
    NACRE_REQUIRE_DATA("measured");
    for (const std::string& material : kMaterials) {
        const RglBrdf brdf(fileOf(material));
        const Truth truth = loadTruth(material);
        ASSERT_EQ(truth.values.size(), 20000u);
        const BrdfComparison c = compareToTruth(truth, [&](auto l, auto v) { return brdf.evaluate(l, v); });
        RecordProperty(material + "_reader_percentile95", std::to_string(c.percentile95));
        // What is left is the six digits of the truth's text.
        EXPECT_LT(c.percentile95, 1e-4) << material;
        // The film's grazing highlight is so steep that six digits of a direction are worth 62.6 dB.
        EXPECT_GT(c.psnr, 60) << material;
    }
}

TEST(RglBrdf, FoldedTableIsOffByTheDatabasesOwnReciprocityError)
{
    NACRE_REQUIRE_DATA("measured");
    for (const std::string& material : kMaterials) {
        const auto brdf = std::make_shared<const RglBrdf>(fileOf(material));
        const BrdfTable table = tabulatedBrdf(brdf);
        const Truth truth = loadTruth(material);
        const auto swapped = compareToTruth(truth, [&](auto l, auto v) { return brdf->evaluate(v, l); });
        const auto tabulated = compareToTruth(truth, [&](auto l, auto v) {
            return evaluateTable(table, {0, 0, 1}, l, v).value;
        });
        RecordProperty(material + "_table_percentile95", std::to_string(tabulated.percentile95));
        RecordProperty(material + "_swapped_percentile95", std::to_string(swapped.percentile95));
        // Folding takes the middle of both ways round: half of what they differ by, and a little for mirror symmetry.
        EXPECT_LT(tabulated.percentile95, 0.75 * swapped.percentile95) << material;
        // What the grid itself costs, on the folded function: alone it would be far below the folding's error.
        const BrdfModel model = brdf;
        const BrdfFunction folded = [&](const glm::vec3& l, const glm::vec3& v) {
            return foldedValue(model, halfDifferenceFromDirections({0, 0, 1}, l, v));
        };
        EXPECT_LT(compareBrdfs(functionOf(modelOf(table)), folded, 20000).percentile95, 0.01) << material;
    }
}

TEST(RglBrdf, TurnsWithTheSample)
{
    NACRE_REQUIRE_DATA("measured");
    const BrdfModel model = std::make_shared<const RglBrdf>(fileOf("vch_golden_yellow"));
    const glm::vec3 l = tangentDirection(0.6, 0.4), v = tangentDirection(0.5, 3.4);
    const glm::vec3 f = evaluate(model, {0, 0, 1}, l, v);
    const glm::vec3 turned = evaluate(model, {0, 0, 1}, tangentDirection(0.6, 2.9), tangentDirection(0.5, 5.9));
    const auto renamed = [](const glm::vec3& a) { return glm::vec3(a.z, a.x, a.y); };
    const glm::vec3 moved = evaluate(model, {1, 0, 0}, renamed(l), renamed(v));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(turned[c], f[c], 1e-4f * f[c]); // float directions near a highlight
        EXPECT_NEAR(moved[c], f[c], 1e-4f * f[c]);
    }
}

TEST(WarpedGrid, OfAConstantDensityIsTheIdentity)
{
    const WarpedGrid grid(4, 3, {0, 1}, std::vector<float>(24, 7.0f));
    for (const glm::dvec2 unit : {glm::dvec2(0, 0), glm::dvec2(0.3, 0.8), glm::dvec2(1, 1), glm::dvec2(0.5, 0.1)}) {
        const glm::dvec2 uniform = grid.uniformFromUnit(unit, 0.4);
        EXPECT_NEAR(uniform.x, unit.x, 1e-6); // sums are kept in float
        EXPECT_NEAR(uniform.y, unit.y, 1e-6);
    }
}

// The warp's Jacobian is the density: mass of a small square over its area.
TEST(WarpedGrid, HasTheDensityAsItsJacobian)
{
    const std::vector<float> density{1, 2, 4, 1, 3, 5, 1, 2, 2, 6, 3, 1, 4, 4, 2, 2, 3, 1, 1, 1, 2, 5, 2, 1};
    const WarpedGrid grid(4, 3, {0, 1}, density);
    const double step = 1e-4;
    for (const double parameter : {0.0, 0.3, 1.0}) {
        for (const glm::dvec2 at : {glm::dvec2(0.2, 0.3), glm::dvec2(0.7, 0.6), glm::dvec2(0.9, 0.2)}) {
            const glm::dvec2 dx = grid.uniformFromUnit(at + glm::dvec2(step, 0), parameter) -
                                  grid.uniformFromUnit(at - glm::dvec2(step, 0), parameter);
            const glm::dvec2 dy = grid.uniformFromUnit(at + glm::dvec2(0, step), parameter) -
                                  grid.uniformFromUnit(at - glm::dvec2(0, step), parameter);
            const double jacobian = (dx.x * dy.y - dx.y * dy.x) / (4 * step * step);
            // Values are normalised to patches of side 1; there are 3x2 of them.
            EXPECT_NEAR(jacobian, 6 * grid.evaluate(at, parameter), 5e-3); // sums in float over a step of 2e-4
        }
    }
}

TEST(RglBrdf, RefusesByName)
{
    const TempFolder folder;
    const std::filesystem::path file = folder / "a.bsdf";
    const auto expectRefused = [&](const std::string& bytes, const std::string& fragment) {
        writeText(file, bytes);
        expectError([&] { RglBrdf{file}; }, {"a.bsdf", fragment});
    };
    const std::string good = tensorFile(1, "rgb");
    writeText(file, good);
    // ndf 1, sigma 1, colour 1: f n.v = 1/4.
    EXPECT_NEAR(RglBrdf(file).evaluate(tangentDirection(0.3, 0), tangentDirection(0.5, 2)).x, 0.25 / std::cos(0.5),
                1e-5);
    expectRefused(tensorFile(8, "rgb"), "anisotropic");
    expectRefused(tensorFile(1, "spectra"), "is spectral");
    expectRefused(tensorFile(1, "other"), "no array 'rgb'");
    expectRefused("not a tensor file", "no tensor file");
    expectRefused("", "no tensor file");
    for (size_t length = 12; length < good.size(); length += 13) {
        writeText(file, good.substr(0, length));
        expectError([&] { RglBrdf{file}; }, {"a.bsdf"});
    }
    std::string nan = good;
    std::memset(nan.data() + nan.size() - 4, 0xFF, 4);
    expectRefused(nan, "no numbers");
    std::string zero = good;
    std::memset(zero.data() + zero.size() - 96 - 32, 0, 16); // the first slice of vndf
    expectRefused(zero, "no density");
}

} // namespace
} // namespace nacre
