#include "engine/view_state/dropped_file.h"

#include <gtest/gtest.h>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/whole_file.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/surface.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

NormalMap plane()
{
    NormalMap normals(4, 3);
    normals.normals.assign(12, glm::vec3(0, 0, 1));
    normals.confidence.assign(12, 1.0f);
    return normals;
}

BrdfTable paint()
{
    return tabulatedBrdf(LambertGgx{}, {6, 4, 4}, {kHalfDifference, 0.4f}, 1);
}

TEST(DroppedFile, IsTakenForWhatItHolds)
{
    const TempFolder folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    saveNormalMap(path("normals.exr"), plane());
    saveBrdfTable(path("paint.exr"), paint());
    saveSurface(path("painted.nacre"), transferredSurface(plane(), {"paint", paint(), {}, {}}), false);
    Surface bare;
    bare.normals = plane();
    bare.labels.assign(12, 0);
    bare.parts = {"plane"};
    saveSurface(path("bare.nacre"), bare, false);
    EXPECT_EQ(kindOf(path("normals.exr")), Dropped::target);
    EXPECT_EQ(kindOf(path("paint.exr")), Dropped::material);
    EXPECT_EQ(kindOf(path("painted.nacre")), Dropped::surface);
    EXPECT_EQ(kindOf(path("bare.nacre")), Dropped::target);
    EXPECT_EQ(kindOf("gold.binary"), Dropped::material);
    EXPECT_EQ(kindOf("sky.hdr"), Dropped::environment);
    EXPECT_EQ(kindOf("state.json"), Dropped::state);
    saveImage(path("sky.exr"), Image(8, 4, 3, 0.3f), PixelType::half);
    NormalMap wide(8, 4);
    wide.normals.assign(32, glm::vec3(0, 0.6f, 0.8f));
    wide.confidence.assign(32, 1.0f);
    saveNormalMap(path("wide.exr"), wide);
    EXPECT_EQ(kindOf(path("sky.exr")), Dropped::environment);
    EXPECT_EQ(kindOf(path("wide.exr")), Dropped::target);
}

TEST(DroppedFile, IsUnknownWhereItHoldsNothing)
{
    const TempFolder folder;
    writeTextFile(folder.path() / "notes.png", "no picture");
    std::filesystem::create_directory(folder.path() / "empty");
    EXPECT_EQ(kindOf(folder.path() / "notes.png"), Dropped::unknown);
    EXPECT_EQ(kindOf(folder.path() / "empty"), Dropped::unknown);
    EXPECT_EQ(kindOf(folder.path() / "missing.exr"), Dropped::unknown);
}

} // namespace
} // namespace nacre
