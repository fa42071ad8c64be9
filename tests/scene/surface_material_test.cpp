// One way of naming the materials of a surface.
#include <gtest/gtest.h>

#include "engine/materials/material_specification.h"
#include "engine/surface/surface_material.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre::test {
namespace {

class SurfaceMaterials : public testing::Test {
protected:
    // Its materials differ by their one value.
    std::string save(const std::string& name, const std::vector<std::string>& materials)
    {
        Surface surface;
        surface.normals = sphereNormalMap(8);
        surface.labels.assign(64, Surface::kNoMaterial);
        for (const std::string& material : materials) {
            BrdfTable table({2, 2, 2}, {kHalfDifference, kHalfPi});
            std::fill(table.values.begin(), table.values.end(), glm::vec3(surface.materials.size() + 1.0f));
            std::fill(table.confidence.begin(), table.confidence.end(), 1.0f);
            surface.materials.push_back({material, table, {}});
        }
        saveSurface(folder_ / name, surface, false);
        return (folder_ / name).string();
    }

    static float valueOf(const std::string& specification)
    {
        return loadMaterial(specification, {}).table.values.at(0).x;
    }

    TempFolder folder_;
};

TEST_F(SurfaceMaterials, AreNamedByNothingNameOrNumber)
{
    const std::string dog = save("dog.nacre", {"fur", "nose", "collar"});
    EXPECT_EQ(valueOf(dog), 1);
    EXPECT_EQ(valueOf(dog + "/"), 1);
    EXPECT_EQ(valueOf(dog + "#nose"), 2);
    EXPECT_EQ(valueOf(dog + "#3"), 3);
    EXPECT_EQ(loadMaterial(dog + "#3", {}).name, "collar");
    // The model is the same table, for whatever wants a model.
    EXPECT_EQ(tableOf(parseMaterial(dog + "#3", {}).model)->values[0].x, 3);
}

TEST_F(SurfaceMaterials, NamesComeBeforeNumbers)
{
    const std::string odd = save("odd.nacre", {"2", "1"});
    EXPECT_EQ(valueOf(odd + "#2"), 1);
    EXPECT_EQ(valueOf(odd + "#1"), 2);
}

TEST_F(SurfaceMaterials, AFolderMayHaveTheMarkInItsName)
{
    const std::string marked = save("dog#2.nacre", {"fur", "nose"});
    EXPECT_EQ(valueOf(marked), 1);
    EXPECT_EQ(valueOf(marked + "#nose"), 2);
}

// What is listed is what loads.
TEST_F(SurfaceMaterials, WhatToTypeLoadsTheMaterial)
{
    for (const auto& names : {std::vector<std::string>{"only"}, {"a", "b"}, {"same", "same"}, {"", "b"}}) {
        const std::string folder = save(names.size() == 1 ? "one.nacre" : names[0] + names[1] + ".nacre", names);
        const Surface surface = loadSurface(folder);
        for (size_t i = 0; i < names.size(); ++i) {
            EXPECT_EQ(valueOf(specificationOf(folder, surface, i)), static_cast<float>(i + 1)) << names[i];
        }
    }
}

TEST_F(SurfaceMaterials, WhatIsNotThereIsSaid)
{
    const std::string dog = save("dog.nacre", {"fur", "nose"}), none = save("none.nacre", {});
    expectError([&] { loadMaterial(dog + "#tail", {}); }, {"dog.nacre", "#tail", "#1 (fur)", "#2 (nose)"},
                Error::kUsage);
    expectError([&] { loadMaterial(dog + "#0", {}); }, {"#0", "#1 (fur)"}, Error::kUsage);
    expectError([&] { loadMaterial(none, {}); }, {"none.nacre", "holds no material"});
    expectError([&] { loadMaterial((folder_ / "gone.nacre").string() + "#1", {}); },
                {"gone.nacre", "is not a surface"});
    expectError([&] { loadMaterial("nothing", {}); }, {"nothing", "NAME.nacre[#MATERIAL]", "lambert:"}, Error::kUsage);
}

// A formula becomes a table that has its values.
TEST_F(SurfaceMaterials, FormulasAreTabulated)
{
    const Material grey = loadMaterial("lambert:0.5", {});
    EXPECT_EQ(grey.name, "lambert:0.5");
    EXPECT_NEAR(evaluateTable(grey.table, {0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}).value.y, 0.5 / 3.14159265, 1e-6);
}

} // namespace
} // namespace nacre::test
