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

std::shared_ptr<const BrdfBasis> basis()
{
    BrdfBasis made{kSize, kDomain, 2, std::vector<float>(2 * 30 * 12 * 10)};
    for (size_t i = 0; i < made.components.size(); ++i) {
        made.components[i] = 0.25f * static_cast<float>(i % 23); // exact in 16 bits
    }
    return std::make_shared<const BrdfBasis>(std::move(made));
}

std::vector<CompactBrdf> models()
{
    SmallTable small{resampledTable(fullTable(), {9, 4, 1}, kDomain), TexelFormat::e5b9g9r9};
    for (glm::vec3& value : small.table.values) {
        value = quantised(value, small.format);
    }
    return {FittedLobe{lobe()}, small, BasisBrdf{basis(), {0.5f, 0.3f, 0.1f, 0.2f, 0.1f, 0.4f}}};
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

TEST(CompactBrdf, SharesABasisInFilesAndInMemory)
{
    const TempFolder folder;
    const auto shared = basis();
    Surface surface = surfaceOf(BasisBrdf{shared, {1, 1, 1, 0, 0, 0}});
    const CompactBrdf second = BasisBrdf{shared, {0, 0, 0, 1, 1, 1}};
    surface.materials.push_back({"second", expandedTable(second, fullTable()), {}, second});
    saveSurface(folder.path() / "s.nacre", surface, false);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "s.nacre" / "basis_0.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "s.nacre" / "basis_1.exr"));
    const std::vector<Material> loaded = loadSurface(folder.path() / "s.nacre").materials;
    EXPECT_EQ(std::get<BasisBrdf>(*loaded[0].compact).basis, std::get<BasisBrdf>(*loaded[1].compact).basis);
    EXPECT_EQ(loaded[1].table.values, surface.materials[1].table.values);
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

TEST(CompactBrdf, RefusesFilesThatItDoesNotUnderstand)
{
    const TempFolder folder;
    saveSurface(folder.path() / "s.nacre", surfaceOf(models()[0]), false);
    const auto json = folder.path() / "s.nacre" / "surface.json";
    const std::string good = readTextFile(json);
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        writeTextFile(json, text.replace(at, from.size(), to));
    };
    replaced("\"lobe\"", "\"low-rank\"");
    const std::string message = messageOf(folder.path() / "s.nacre");
    EXPECT_NE(message.find("surface.json"), std::string::npos) << message;
    EXPECT_NE(message.find("\"low-rank\""), std::string::npos) << message;
    EXPECT_NE(message.find("lobe, table"), std::string::npos) << message;
}

TEST(CompactBrdf, RefusesABasisThatDoesNotGoWithItsMaterial)
{
    const TempFolder folder;
    saveSurface(folder.path() / "s.nacre", surfaceOf(models()[2]), false);
    const auto json = folder.path() / "s.nacre" / "surface.json";
    std::string text = readTextFile(json);
    const size_t at = text.find("\"rank\": 2");
    ASSERT_NE(at, std::string::npos);
    writeTextFile(json, text.replace(at, 9, "\"rank\": 1"));
    EXPECT_THROW(loadSurface(folder.path() / "s.nacre"), Error);
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
