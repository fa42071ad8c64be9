#include <cmath>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/surface/surface.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

constexpr TableDomain kDomain{kHalfDifference, 0.44f};
constexpr glm::ivec3 kSize{30, 12, 10};

BrdfTable fullTable()
{
    return tabulatedBrdf(LambertGgx{{0.4f, 0.3f, 0.2f}, glm::vec3(0.05f), 0.3f}, kSize, kDomain, 1);
}

AbcModel lobe()
{
    AbcModel m;
    m.kD = {0.4f, 0.3f, 0.1f};
    m.A = {5, 4, 3};
    m.B = 300;
    m.C = 1.2f;
    m.ior = 1.5f;
    return m;
}

Surface surfaceOf(const CompactBrdf& model)
{
    NormalMap normals(2, 2);
    normals.normals.assign(4, glm::vec3(0, 0, 1));
    normals.confidence.assign(4, 1.0f);
    return transferredSurface(normals, {"compact", expandedTable(model, fullTable()), {}, model});
}

std::vector<CompactBrdf> models()
{
    SmallTable small{resampledTable(fullTable(), {9, 4, 1}, kDomain), TexelFormat::e5b9g9r9};
    for (glm::vec3& value : small.table.values) {
        value = quantised(value, small.format);
    }
    return {FittedLobe{lobe()}, small};
}

std::string messageOf(const std::filesystem::path& surface)
{
    try {
        loadSurface(surface);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(CompactBrdf, ComesBackFromItsFilesWithTheSameTable)
{
    for (const CompactBrdf& model : models()) {
        const TempFolder folder;
        const Surface surface = surfaceOf(model);
        saveSurface(folder.path() / "s.nacre", surface, false);
        const Material loaded = loadSurface(folder.path() / "s.nacre").materials.front();
        const BrdfTable& table = surface.materials.front().table;
        ASSERT_TRUE(loaded.compact);
        EXPECT_EQ(nameOf(*loaded.compact), nameOf(model));
        EXPECT_EQ(bytesOf(*loaded.compact), bytesOf(model));
        ASSERT_EQ(loaded.table.size, table.size);
        for (size_t texel = 0; texel < table.values.size(); ++texel) {
            EXPECT_EQ(loaded.table.values[texel], table.values[texel]);
        }
    }
}

TEST(CompactBrdf, ResamplesOntoAWiderRangeWithoutCoverage)
{
    const BrdfTable table = fullTable(), wider = resampledTable(table, kSize, {kHalfDifference, 2 * kDomain.thetaDMax});
    EXPECT_EQ(wider.domain.thetaDMax, 2 * kDomain.thetaDMax);
    const glm::vec3 unit(0.4f, 0.6f, 0.5f), half(0.4f, 0.3f, 0.5f);
    EXPECT_NEAR(sampleTable(wider, half).value.x, sampleTable(table, unit).value.x, 0.01f); // twice as coarse
    EXPECT_EQ(sampleTable(wider, {0.4f, 0.8f, 0.5f}).confidence, 0.0f);
    EXPECT_GT(sampleTable(wider, half).confidence, 0.9f);
}

TEST(CompactBrdf, KeepsTheExpectedError)
{
    BrdfTable table = fullTable();
    table.error.assign(table.values.size(), 0.1f);
    const BrdfTable wider = resampledTable(table, kSize, {kHalfDifference, 2 * kDomain.thetaDMax});
    EXPECT_FLOAT_EQ(sampleError(wider, {0.4f, 0.3f, 0.5f}), 0.1f);
    EXPECT_FLOAT_EQ(sampleError(wider, {0.4f, 0.8f, 0.5f}), kUnknownError) << "beyond the table's own range";
    for (const CompactBrdf& model : models()) {
        const TempFolder folder;
        Surface surface = surfaceOf(model);
        surface.materials.front().table = expandedTable(model, table);
        saveSurface(folder.path() / "s.nacre", surface, false);
        const BrdfTable loaded = loadSurface(folder.path() / "s.nacre").materials.front().table;
        EXPECT_FLOAT_EQ(sampleError(loaded, {0.4f, 0.3f, 0.5f}), 0.1f) << nameOf(model);
    }
}

TEST(CompactBrdf, RefusesModelsThatItDoesNotKnow)
{
    const TempFolder folder;
    saveSurface(folder.path() / "s.nacre", surfaceOf(models()[0]), false);
    const auto json = folder.path() / "s.nacre" / "surface.json";
    const std::string good = readTextFile(json);
    for (const char* kind : {"\"low-rank\"", "\"basis\"", "\"spline\""}) {
        std::string text = good;
        writeTextFile(json, text.replace(text.find("\"lobe\""), 6, kind));
        const std::string message = messageOf(folder.path() / "s.nacre");
        for (const char* fragment : {"surface.json", kind, "lobe or table"}) {
            EXPECT_NE(message.find(fragment), std::string::npos) << message;
        }
    }
}

TEST(TexelFormat, KeepsWhatItPromises)
{
    for (const float value : {0.0f, 1e-3f, 0.02f, 0.7f, 3.0f, 517.0f, 60000.0f}) {
        const glm::vec3 v(value, 0.5f * value, 0.25f * value);
        EXPECT_EQ(quantised(v, TexelFormat::rgba32f), v);
        const glm::vec3 half = quantised(v, TexelFormat::rgba16f), shared = quantised(v, TexelFormat::e5b9g9r9);
        EXPECT_LE(std::abs(half.x - value), value / 2048);                // 11 bits, rounded
        EXPECT_LE(glm::length(shared - v), 1.8f * value / 512 + 1.2e-7f); // 9 bits of the largest channel
        // Once quantised, nothing more is lost: what lies in a file is what the device holds.
        EXPECT_EQ(quantised(half, TexelFormat::rgba16f), half);
        EXPECT_EQ(quantised(shared, TexelFormat::e5b9g9r9), shared);
    }
    EXPECT_TRUE(std::isfinite(quantised(glm::vec3(1e9f), TexelFormat::rgba16f).x));
    EXPECT_EQ(quantised(glm::vec3(-1), TexelFormat::e5b9g9r9), glm::vec3(0));
    EXPECT_THROW(texelFormatFromName("RGB8"), Error);
}

} // namespace
} // namespace nacre
