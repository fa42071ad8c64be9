// Green that points the wrong way is told by what it would do to a height; what cannot tell keeps silent.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "assets/targets.h"
#include "engine/target/normal_map_source.h"
#include "tests/support/data_folder.h"

namespace nacre::test {
namespace {

NormalMap flipped(NormalMap map)
{
    for (glm::vec3& n : map.normals) {
        n.y = -n.y;
    }
    return map;
}

void expectTold(const NormalMap& map)
{
    EXPECT_EQ(checkIntegrability(map).verdict, GreenVerdict::agrees) << checkIntegrability(map).residualRatio;
    EXPECT_EQ(checkIntegrability(flipped(map)).verdict, GreenVerdict::flipped);
}

TEST(Integrability, TellsRealMaps)
{
    NACRE_REQUIRE_DATA("targets");
    for (const char* name :
         {"godot_wool_normal.png", "polyhaven_dutch_ship_medium_sails_nor_gl_1k.jpg", "buddha_normal16.png",
          "harvest_normal16.png", "Hermes_normals.png", "DeChalon_normals.png"}) {
        SCOPED_TRACE(name);
        expectTold(loadNormalMap(dataFolder() / "targets" / name));
    }
}

TEST(Integrability, TellsOurOwnMaps)
{
    for (const TargetName& target : targetNames()) {
        SCOPED_TRACE(target.name);
        const NormalMap map = makeTarget(target.name, 200, 200).normals;
        EXPECT_NE(checkIntegrability(map).verdict, GreenVerdict::flipped) << checkIntegrability(map).residualRatio;
        EXPECT_NE(checkIntegrability(flipped(map)).verdict, GreenVerdict::agrees);
    }
    for (const char* name : {"cloth", "head", "sphere"}) {
        SCOPED_TRACE(name);
        expectTold(makeTarget(name, 256, 256).normals);
    }
}

// Flat, folds along one axis, and white noise of a few codes on a flat map: both readings explain them alike.
TEST(Integrability, SaysNothingOfWhatCannotTell)
{
    NormalMap flat(200, 200), folds(200, 200), noise(200, 200);
    uint32_t state = 1;
    const auto random = [&state] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / (1 << 24) - 0.5f;
    };
    for (size_t i = 0; i < flat.normals.size(); ++i) {
        const float x = static_cast<float>(i % 200);
        flat.normals[i] = {0, 0, 1};
        folds.normals[i] = glm::normalize(glm::vec3(std::sin(x / 9), 0.2f, 1));
        noise.normals[i] = glm::normalize(glm::vec3(0.02f * random(), 0.02f * random(), 1));
        flat.confidence[i] = folds.confidence[i] = noise.confidence[i] = 1;
    }
    for (const NormalMap* map : {&flat, &folds, &noise}) {
        EXPECT_EQ(checkIntegrability(*map).verdict, GreenVerdict::undecided);
        EXPECT_EQ(checkIntegrability(flipped(*map)).verdict, GreenVerdict::undecided);
    }
}

TEST(Integrability, TheWarningSaysWhereGreenPoints)
{
    const NormalMap head = makeTarget("head", 256, 256).normals;
    EXPECT_EQ(flippedGreenWarning("a.png", head, NormalY::gl), "");
    EXPECT_NE(flippedGreenWarning("a.png", flipped(head), NormalY::gl).find("point down"), std::string::npos);
    EXPECT_NE(flippedGreenWarning("a.png", flipped(head), NormalY::dx).find("point up"), std::string::npos);
}

} // namespace
} // namespace nacre::test
