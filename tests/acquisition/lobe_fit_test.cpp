// Fits of the exchange formats' models.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <regex>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/exchange/lobe_fit.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/exchange/materialx_file.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

constexpr TableDomain kWide{kHalfDifference, 0.8f};

struct Judged {
    BrdfTable table;
    ModelJudge judge;

    template <class F>
    explicit Judged(const F& f)
        : table({60, 12, 12}, kWide), judge(
                                          [f](const glm::vec3& unit) {
                                              const LightView d = directionsFromUnit(kWide, unit);
                                              return InterpolatedValue{f(glm::vec3(0, 0, 1), d.l, d.v), 0};
                                          },
                                          covered(table), 1)
    {
    }
    static BrdfTable& covered(BrdfTable& table)
    {
        std::fill(table.confidence.begin(), table.confidence.end(), 1.0f);
        return table;
    }
};

Judged judgedLobes(ExchangeFormat format, const LobeShape& shape, const LobeColours& colours)
{
    const std::shared_ptr<LobeModel> model = modelOf(format, shape, colours.sheen != glm::vec3(0));
    return Judged(
        [=](const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) { return model->evaluate(colours, n, l, v); });
}

// The refined grid stops within a percent of the roughness.
TEST(LobeFitSlow, FindsTheParametersThatMadeTheData)
{
    const LobeShape plastic{.roughness = 0.42f}, metal{.roughness = 0.3f, .metallic = 1};
    const LobeColours coloured{{0.5f, 0.3f, 0.1f}, glm::vec3(0.04f), {}}, gold{{}, {0.9f, 0.7f, 0.3f}, {}};
    for (const auto format : {ExchangeFormat::gltf, ExchangeFormat::standardSurface}) {
        const Judged a =
            judgedLobes(format, plastic,
                        format == ExchangeFormat::gltf ? coloured : LobeColours{coloured.diffuse, glm::vec3(1), {}});
        const LobeFit first = fitLobes(a.judge, format, 1, 1);
        EXPECT_GT(first.psnr, 45);
        EXPECT_NEAR(first.shape.roughness, 0.42f, 0.01f);
        EXPECT_LT(glm::length(first.colours.diffuse - coloured.diffuse), 0.02f);
        const Judged b = judgedLobes(format, metal, gold);
        const LobeFit second = fitLobes(b.judge, format, 1, 1);
        EXPECT_GT(second.psnr, 45);
        EXPECT_TRUE(second.shape.isMetal());
        EXPECT_LT(glm::length(second.colours.specular - gold.specular), 0.05f);
    }
}

TEST(LobeFitSlow, ExtensionsAreTakenWhereTheyPay)
{
    const Judged plain =
        judgedLobes(ExchangeFormat::gltf, {.roughness = 0.4f}, {glm::vec3(0.4f), glm::vec3(0.04f), {}});
    const LobeFit core = fitLobes(plain.judge, ExchangeFormat::gltf, 1, 1);
    EXPECT_EQ(core.psnr, core.corePsnr);
    EXPECT_FALSE(core.hasSheen());
    const Judged shiny =
        judgedLobes(ExchangeFormat::gltf, {.roughness = 0.3f}, {{0.4f, 0.1f, 0.1f}, glm::vec3(0.15f), {}});
    const LobeFit extended = fitLobes(shiny.judge, ExchangeFormat::gltf, 1, 1);
    EXPECT_GT(extended.psnr, extended.corePsnr + 3);
    EXPECT_NEAR(extended.colours.specular.x, 0.15f, 0.01f);
}

TEST(LobeFitSlow, SaysWhereNoParametersComeNear)
{
    const Judged back([](const glm::vec3&, const glm::vec3& l, const glm::vec3& v) {
        return glm::vec3(std::pow(std::max(glm::dot(l, v), 0.0f), 200.0f)); // a reflector that sends light back
    });
    const LobeFit none = fitLobes(back.judge, ExchangeFormat::gltf, 1, 1);
    EXPECT_TRUE(isNothing(none, fitScale(back.judge)));
    EXPECT_TRUE(isFar(none, fitScale(back.judge)));
    const Judged plain =
        judgedLobes(ExchangeFormat::gltf, {.roughness = 0.4f}, {glm::vec3(0.4f), glm::vec3(0.04f), {}});
    const LobeFit good = fitLobes(plain.judge, ExchangeFormat::gltf, 1, 1);
    EXPECT_FALSE(isNothing(good, fitScale(plain.judge)) || isFar(good, fitScale(plain.judge)));
}

// glTF's formulas are reciprocal, and a lobe without diffuse part reflects at most all light: E <= 1.
TEST(LobeModel, GltfIsReciprocalAndMakesNoEnergy)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto direction = [&] {
        const float z = 0.05f + 0.95f * unit(random), phi = 2 * kPi * unit(random), s = std::sqrt(1 - z * z);
        return glm::vec3(s * std::cos(phi), s * std::sin(phi), z);
    };
    const LobeColours colours{glm::vec3(0.5f), glm::vec3(0.04f), glm::vec3(0.3f)};
    const auto model = gltfModel({.roughness = 0.4f, .sheenRoughness = 0.5f}, true);
    const auto white = gltfModel({.roughness = 0.4f, .metallic = 1}, false);
    double sum = 0;
    constexpr int kSamples = 20000;
    const glm::vec3 n(0, 0, 1), view = glm::normalize(glm::vec3(0.5f, 0, 1));
    for (int i = 0; i < kSamples; ++i) {
        const glm::vec3 l = direction(), v = direction();
        const float f = model->evaluate(colours, n, l, v).x;
        EXPECT_NEAR(f, model->evaluate(colours, n, v, l).x, 1e-4f * std::max(f, 1.0f));
        sum += white->evaluate({{}, glm::vec3(1), {}}, n, l, view).x * l.z * 2 * kPi * 0.95;
    }
    EXPECT_LT(sum / kSamples, 1.02);
    EXPECT_GT(sum / kSamples, 0.85); // a single bounce loses some
}

// By MaterialX 1.38, standard_surface 1.0.1: names and types of its inputs.
TEST(MaterialX, HasTheNodesInputsAndEscapesNames)
{
    const std::string text = materialXText(
        {{"a \"b\" <\xc3\xa9>&", {.roughness = 0.3f}, {glm::vec3(0.5f), glm::vec3(0.5f), glm::vec3(0.1f)}},
         {"a \"b\" <\xc3\xa9>&", {.metallic = 1}, {{}, glm::vec3(0.9f), {}}}},
        2);
    EXPECT_NE(text.find("uiname=\"a &quot;b&quot; &lt;\xc3\xa9&gt;&amp;\""), std::string::npos) << text;
    EXPECT_NE(text.find("doc=\"Radiance is to be multiplied by 2\""), std::string::npos);
    const std::map<std::string, std::string> types = {{"base", "float"},
                                                      {"base_color", "color3"},
                                                      {"metalness", "float"},
                                                      {"specular", "float"},
                                                      {"specular_color", "color3"},
                                                      {"specular_roughness", "float"},
                                                      {"specular_IOR", "float"},
                                                      {"sheen", "float"},
                                                      {"sheen_color", "color3"},
                                                      {"sheen_roughness", "float"},
                                                      {"surfaceshader", "surfaceshader"}};
    const std::regex input("<input name=\"([^\"]+)\" type=\"([^\"]+)\" (value|nodename)=\"([^\"]+)\" />");
    size_t inputs = 0;
    std::set<std::string> names, uses;
    for (std::sregex_iterator at(text.begin(), text.end(), input), end; at != end; ++at, ++inputs) {
        ASSERT_TRUE(types.contains((*at)[1])) << (*at)[1];
        EXPECT_EQ(types.at((*at)[1]), (*at)[2]) << (*at)[1];
        const std::string value = (*at)[4];
        EXPECT_EQ(std::count(value.begin(), value.end(), ','), (*at)[2] == "color3" ? 2 : 0) << value;
        if ((*at)[3] == "nodename") {
            uses.insert(value);
        }
    }
    size_t tags = 0;
    for (size_t at = text.find("<input"); at != text.npos; at = text.find("<input", at + 1)) {
        ++tags;
    }
    EXPECT_EQ(inputs, tags);
    const std::regex node("<(standard_surface|surfacematerial) name=\"([A-Za-z_][A-Za-z0-9_]*)\"");
    for (std::sregex_iterator at(text.begin(), text.end(), node), end; at != end; ++at) {
        EXPECT_TRUE(names.insert((*at)[2]).second) << (*at)[2];
    }
    EXPECT_EQ(names.size(), 4u);
    EXPECT_EQ(uses.size(), 2u);
    for (const std::string& use : uses) {
        EXPECT_TRUE(names.contains(use)) << use;
    }
}

} // namespace
} // namespace nacre
