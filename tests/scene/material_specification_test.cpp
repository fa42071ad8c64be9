#include "engine/materials/material_specification.h"

#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "tests/support/data_folder.h"

namespace nacre {
namespace {

// The message of the usage error that `specification` meets; empty where it is accepted.
std::string refusal(const std::string& specification, const std::filesystem::path& fits = {})
{
    try {
        parseMaterial(specification, fits);
    } catch (const Error& e) {
        EXPECT_EQ(e.exitCode(), Error::kUsage);
        return e.what();
    }
    return "";
}

TEST(MaterialSpecification, ReadsLambert)
{
    auto model = std::get<LambertGgx>(parseMaterial("lambert:0.6,0.5,0.4", {}).model);
    EXPECT_EQ(model.diffuse, glm::vec3(0.6f, 0.5f, 0.4f));
    EXPECT_EQ(model.specular, glm::vec3(0));
    EXPECT_EQ(std::get<LambertGgx>(parseMaterial("lambert:0.5", {}).model).diffuse, glm::vec3(0.5f));
}

TEST(MaterialSpecification, ReadsGgxInAnyOrder)
{
    auto model = std::get<LambertGgx>(parseMaterial("ggx:alpha=0.2;diffuse=0.5,0.3,0.2;specular=0.04", {}).model);
    EXPECT_EQ(model.diffuse, glm::vec3(0.5f, 0.3f, 0.2f));
    EXPECT_EQ(model.specular, glm::vec3(0.04f));
    EXPECT_EQ(model.alpha, 0.2f);
    EXPECT_EQ(std::get<LambertGgx>(parseMaterial("ggx:alpha=0.1", {}).model).diffuse, LambertGgx{}.diffuse);
}

TEST(MaterialSpecification, RefusesByName)
{
    EXPECT_NE(refusal("velvet:1").find("knows no model \"velvet\""), std::string::npos);
    EXPECT_NE(refusal("lambert:0.5,0.5").find("has 2 numbers"), std::string::npos);
    EXPECT_NE(refusal("lambert:").find("has 0 numbers"), std::string::npos);
    EXPECT_NE(refusal("lambert:red").find("\"red\" is no number"), std::string::npos);
    EXPECT_NE(refusal("lambert:1.5").find("is no reflectance"), std::string::npos);
    EXPECT_NE(refusal("lambert:nan").find("is no reflectance"), std::string::npos);
    EXPECT_NE(refusal("ggx:roughness=0.1").find("knows no \"roughness\""), std::string::npos);
    EXPECT_NE(refusal("ggx:alpha=0").find("alpha \"0\""), std::string::npos);
    EXPECT_NE(refusal("merl-abc:brass").find("NACRE_FITS_DIR"), std::string::npos);
    EXPECT_NE(refusal("garnet_red.brdf").find("scattered measurements"), std::string::npos);
}

TEST(MaterialSpecification, NamesNearFits)
{
    NACRE_REQUIRE_DATA("measured");
    std::filesystem::path fits = dataFolder() / "measured";
    EXPECT_NE(refusal("merl-sgd:red-plastik", fits).find("red-plastic"), std::string::npos);
    EXPECT_NE(refusal("merl-abc:phenolic", fits).find("black-phenolic"), std::string::npos);
}

} // namespace
} // namespace nacre
