#include "engine/view_state/controls.h"

#include <functional>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace nacre {
namespace {

constexpr const char* kSurface = "/s/horse.nacre";

Choices someChoices()
{
    return {.surface = kSurface,
            .materials = {{"horse", ""}, {"gold", "/m/gold.binary"}, {"grey", "lambert:0.5"}},
            .targets = {{"horse", ""}, {"cloth", "/t/cloth.exr"}},
            .environments = {"/e/studio.hdr", "/e/sky.hdr"},
            .captured = {{"a.png", {.direction = {0, 0, 1}}},
                         {"b.png", {.direction = {0.6f, 0, 0.8f}, .irradiance = {1, 2, 3}}},
                         {"c.png", {.direction = {0, 0.6f, 0.8f}}}}};
}

Session opened()
{
    Session session;
    session.state.surface = kSurface;
    resolveCaptured(session.state, someChoices().captured);
    session.state.exposure = 1.0f;
    session.opened = session.state;
    return session;
}

Session after(std::initializer_list<KeyPress> keys, Session session = opened())
{
    const Choices choices = someChoices();
    for (const KeyPress& key : keys) {
        act(session, choices, key);
    }
    return session;
}

TEST(Shapes, OneKeyStepsThroughThem)
{
    const KeyPress step{.key = 'T'};
    EXPECT_EQ(after({step}).state.onto, "/t/cloth.exr");
    EXPECT_EQ(after({step, step}).state, opened().state);
}

TEST(Shapes, AWayBackTurnsAMeshBack)
{
    Session session = opened();
    session.canTurn = true;
    turnObject(session, {17, -333});
    EXPECT_EQ(session.state.turn, (Turn{.yaw = 4.25f, .pitch = -83.25f}));
    turnObject(session, {-17, 333});
    EXPECT_EQ(session.state, opened().state);
    turnObject(session, {1450, 1000});
    EXPECT_EQ(session.state.turn, (Turn{.yaw = 2.5f, .pitch = 90})) << "once around, and not upside down";
}

TEST(Shapes, LightsStayOrTurnWithTheObject)
{
    Session session = opened();
    session.canTurn = true;
    session.state.lights = {LightSource{.direction = {0, 0, 2}}, LightSource{.direction = {0, 1, 0}}};
    const std::vector<LightSource> before = session.state.lights;
    turnObject(session, {360, 0}); // a quarter of a turn
    EXPECT_EQ(session.state.lights, before);
    act(session, someChoices(), Action::follow);
    turnObject(session, {-360, 0});
    EXPECT_NEAR(session.state.lights[0].direction.x, -2, 1e-6f) << "from the front to the left";
    EXPECT_NEAR(session.state.lights[1].direction.y, 1, 1e-6f) << "on the axis";
    turnObject(session, {360, 0});
    EXPECT_NEAR(session.state.lights[0].direction.z, 2, 1e-6f);
}

TEST(Shapes, WhatHasNoMeshStays)
{
    Session session = opened();
    turnObject(session, {10, 10});
    EXPECT_EQ(session.state, opened().state);
    EXPECT_NE(session.message, "");
    session.canTurn = true;
    turnObject(session, {10, 10});
    chooseTarget(session, someChoices(), 1);
    EXPECT_EQ(session.state.turn, Turn()) << "another shape is not turned";
}

TEST(Lights, ThePushedOneComesNearerAndGoesAway)
{
    Session session = opened();
    pushLight(session, 0);
    EXPECT_EQ(session.state.lights[0].captured, 1);
    pushLight(session, 1);
    EXPECT_EQ(session.state.lights[0].distance, LightSource().distance) << "it is distant already";
    pushLight(session, -1);
    EXPECT_FLOAT_EQ(session.state.lights[0].distance, kFarthestChosen);
    EXPECT_EQ(session.state.lights[0].captured, 0);
    pushLight(session, -4);
    EXPECT_NEAR(session.state.lights[0].distance, kFarthestChosen / 2, 1e-3);
    pushLight(session, 4);
    EXPECT_NEAR(session.state.lights[0].distance, kFarthestChosen, 1e-3);
    pushLight(session, -100);
    EXPECT_GE(session.state.lights[0].distance, kNearestLight) << "never inside the object";
    EXPECT_EQ(lightSourceFromText(textOf(session.state.lights[0])), session.state.lights[0]);
    pushLight(session, 100);
    EXPECT_EQ(session.state.lights[0].distance, LightSource().distance);
}

TEST(KeyTable, EveryActionHasAKeyAndAHelp)
{
    std::set<Action> bound, helped;
    for (const KeyBinding& binding : keyBindings()) {
        bound.insert(binding.action);
    }
    for (const ActionHelp& help : actionHelp()) {
        EXPECT_TRUE(helped.insert(help.action).second) << help.text << " is there twice";
    }
    EXPECT_EQ(bound, helped);
}

// What a help line calls a key, pressed.
KeyPress pressOf(const std::string& name)
{
    if (name == "Space") {
        return {' '};
    }
    if (name == "Esc") {
        return {kKeyEscape};
    }
    if (name == "F12") {
        return {kKeyF12};
    }
    KeyPress press{.key = name.back()};
    press.shift = name.find("Shift+") != std::string::npos;
    press.control = name.starts_with("Ctrl+");
    return press;
}

TEST(KeyTable, TheHelpNamesTheKeysThatDoIt)
{
    for (const ActionHelp& help : actionHelp()) {
        std::string keys = help.keys;
        for (const char* between : {" or ", " to "}) {
            if (const size_t at = keys.find(between); at != std::string::npos) {
                const KeyBinding* second = bindingOf(pressOf(keys.substr(at + std::string(between).size())));
                ASSERT_NE(second, nullptr) << help.keys;
                EXPECT_EQ(second->action, help.action) << help.keys;
                keys.resize(at);
            }
        }
        const KeyBinding* binding = bindingOf(pressOf(keys));
        ASSERT_NE(binding, nullptr) << keys;
        EXPECT_EQ(binding->action, help.action) << keys;
    }
    EXPECT_EQ(bindingOf({'Q'}), nullptr);
    EXPECT_EQ(bindingOf({'S'}), nullptr) << "without Ctrl";
}

TEST(Controls, KeysShowAndHide)
{
    EXPECT_EQ(after({{'N'}}).state.show, Show::normals);
    EXPECT_EQ(after({{'N'}, {'N'}}).state.show, Show::picture);
    EXPECT_EQ(after({{'C'}}).state.show, Show::coverage);
    EXPECT_EQ(after({{'N'}, {'L'}}).state.show, Show::labels);
    EXPECT_TRUE(after({{'H'}}).help);
    EXPECT_TRUE(after({{.key = '/', .shift = true}}).help);
    EXPECT_FALSE(after({{'H'}, {'H'}}).help);
}

TEST(Controls, ExposureStepsUpAndDown)
{
    EXPECT_EQ(*after({{'E'}}).state.exposure, 1 + kExposureStep);
    EXPECT_EQ(*after({{'E'}, {.key = 'E', .shift = true}}).state.exposure, 1);
}

TEST(Controls, AHeldKeyStepsButDoesNotFlicker)
{
    EXPECT_EQ(*after({{'E'}, {.key = 'E', .isRepeat = true}}).state.exposure, 1 + 2 * kExposureStep);
    EXPECT_EQ(after({{'N'}, {.key = 'N', .isRepeat = true}}).state.show, Show::normals);
}

TEST(Controls, EscapeClosesTheHelpFirst)
{
    const Session closed = after({{'H'}, {kKeyEscape}});
    EXPECT_FALSE(closed.help);
    EXPECT_FALSE(closed.wantsToQuit);
    EXPECT_TRUE(after({{kKeyEscape}}).wantsToQuit);
}

TEST(Controls, MaterialsByNumber)
{
    const Session gold = after({{'2'}});
    EXPECT_EQ(gold.state.material, "/m/gold.binary");
    EXPECT_EQ(gold.state.surface, "");
    EXPECT_EQ(gold.state.onto, kSurface) << "another material keeps the shape";
    EXPECT_EQ(gold.state.lights[0].captured, 0) << "which names no captured lights";
    EXPECT_EQ(chosenMaterial(gold.state, someChoices()), 1u);
    const Session back = after({{'2'}, {'1'}});
    EXPECT_EQ(back.state.surface, kSurface);
    EXPECT_EQ(back.state.onto, "");
    EXPECT_EQ(after({{'9'}}).state, opened().state) << "there is no ninth";
}

TEST(Controls, TargetsKeepTheMaterial)
{
    const Choices choices = someChoices();
    Session session = after({{'2'}});
    chooseTarget(session, choices, 1);
    EXPECT_EQ(session.state.material, "/m/gold.binary");
    EXPECT_EQ(session.state.onto, "/t/cloth.exr");
    act(session, choices, {'1'});
    EXPECT_EQ(session.state.surface, kSurface);
    EXPECT_EQ(session.state.onto, "/t/cloth.exr");
    chooseTarget(session, choices, 0);
    EXPECT_EQ(session.state.onto, "");
}

TEST(Controls, CapturedLightsGoRound)
{
    EXPECT_EQ(after({{']'}}).photograph, 1u) << "the first one is what a surface opens with";
    EXPECT_EQ(after({{'['}}).photograph, 2u);
    EXPECT_EQ(after({{']'}, {']'}, {']'}}).photograph, 0u);
    Session moved = opened();
    pointLight(moved, {0.5f, 0});
    EXPECT_EQ(after({{']'}}, moved).photograph, 0u) << "from a light that is none of them to the first";
    const Session second = after({{']'}});
    ASSERT_EQ(second.state.lights.size(), 1u);
    EXPECT_EQ(second.state.lights[0].captured, 2);
    EXPECT_EQ(second.state.lights[0].irradiance, glm::vec3(1, 2, 3));
}

TEST(Controls, PhotographsNeedACapture)
{
    EXPECT_EQ(after({{'P'}}).comparison, Comparison::none);
    Session session = opened();
    session.hasPhotographs = true;
    EXPECT_EQ(after({{'P'}}, session).comparison, Comparison::photograph);
    EXPECT_EQ(after({{'P'}}, session).photograph, 0u) << "some light has to be on screen";
    EXPECT_EQ(after({{'P'}, {'X'}}, session).comparison, Comparison::difference);
    EXPECT_EQ(after({{'P'}, {'X'}, {'X'}}, session).comparison, Comparison::none);
    Session moved = after({{'P'}}, session);
    pointLight(moved, {0.5f, 0});
    EXPECT_EQ(moved.comparison, Comparison::none) << "that light was not photographed";
}

TEST(Controls, VerdictsAreOnThePhotographOnScreen)
{
    const Session without = after({{'V'}});
    EXPECT_EQ(without.state, opened().state);
    EXPECT_NE(without.message.find("capture"), std::string::npos) << "no dead key: " << without.message;
    Session session = opened();
    session.hasPhotographs = true;
    EXPECT_EQ(after({{'V'}}, session).state.show, Show::verdicts);
    EXPECT_EQ(after({{']'}, {'V'}}, session).state.lights[0].captured, 2);
    EXPECT_EQ(after({{'V'}, {']'}}, session).state.show, Show::verdicts) << "the next one's";
    EXPECT_EQ(after({{'V'}, {'V'}}, session).state.show, Show::picture);
    EXPECT_EQ(after({{'V'}, {'N'}}, session).state.show, Show::normals);
    EXPECT_EQ(after({{'P'}, {'V'}}, session).comparison, Comparison::none);
    EXPECT_EQ(after({{'V'}, {'P'}}, session).state.show, Show::picture);
}

TEST(Controls, VerdictsEndWithThePhotograph)
{
    Session session = opened();
    session.hasPhotographs = true;
    session = after({{']'}, {'V'}}, session);
    const auto settled = [&](const std::function<void(Session&)>& change) {
        Session changed = session;
        change(changed);
        settleShow(changed);
        return changed.state.show;
    };
    EXPECT_EQ(settled([](Session&) {}), Show::verdicts);
    EXPECT_EQ(settled([](Session& s) { s.state.exposure = 3; }), Show::verdicts);
    EXPECT_EQ(settled([](Session& s) { pointLight(s, {0.5f, 0}); }), Show::picture);
    EXPECT_EQ(settled([](Session& s) { addLight(s); }), Show::picture);
    EXPECT_EQ(settled([](Session& s) { play(s, 0.1f); }), Show::picture);
    EXPECT_EQ(settled([](Session& s) { chooseMaterial(s, someChoices(), 1); }), Show::picture);
    EXPECT_EQ(settled([](Session& s) { chooseTarget(s, someChoices(), 1); }), Show::picture);
    EXPECT_EQ(settled([](Session& s) { chooseEnvironment(s, someChoices(), 0); }), Show::picture);
    Session moved = session;
    pointLight(moved, {0.5f, 0});
    settleShow(moved);
    EXPECT_EQ(after({{'V'}}, moved).state.lights[0].captured, 1) << "that light was not photographed";
}

TEST(Controls, TheResidualLayerGoesOnOffAndAlone)
{
    Session session = opened();
    session.hasResidual = session.hasPhotographs = true;
    EXPECT_EQ(after({{'D'}}, session).state.residual, ResidualUse::off);
    EXPECT_EQ(after({{'D'}, {'D'}}, session).state.residual, ResidualUse::alone);
    EXPECT_EQ(after({{'D'}, {'D'}, {'D'}}, session).state.residual, ResidualUse::on);
    EXPECT_EQ(after({{'N'}, {'D'}}, session).state.show, Show::picture) << "normals would not show it";
    EXPECT_EQ(after({{'C'}, {'D'}}, session).state.show, Show::coverage);
    EXPECT_EQ(after({{'X'}, {'D'}}, session).comparison, Comparison::difference) << "of what the BRDF alone misses";
    EXPECT_EQ(after({{'X'}, {'D'}, {'D'}}, session).comparison, Comparison::none);
    EXPECT_EQ(after({{'D'}, {'D'}, {'X'}}, session).state.residual, ResidualUse::on);
}

TEST(Controls, WithoutAResidualLayerItsKeySaysSo)
{
    const Session without = after({{'D'}});
    EXPECT_EQ(without.state, opened().state);
    EXPECT_NE(without.message.find("no residual layer"), std::string::npos) << without.message;
    Session session = opened();
    session.hasResidual = true;
    session = after({{'D'}, {'D'}}, session);
    settleShow(session);
    EXPECT_EQ(session.state.residual, ResidualUse::alone);
    session.hasResidual = false; // another material was put on
    settleShow(session);
    EXPECT_EQ(session.state.residual, ResidualUse::on);
}

TEST(Controls, AnEnvironmentStandsInPlaceOfLights)
{
    const Choices choices = someChoices();
    Session session = opened();
    chooseEnvironment(session, choices, 1);
    EXPECT_EQ(session.state.environment, "/e/sky.hdr");
    EXPECT_TRUE(session.state.lights.empty());
    chooseEnvironment(session, choices, 7);
    EXPECT_EQ(session.state.environment, "/e/sky.hdr") << "there is no eighth";
    chooseEnvironment(session, choices, {});
    EXPECT_TRUE(session.state.environment.empty());
    EXPECT_EQ(session.state.lights.size(), 1u) << "something has to light the scene";
}

TEST(Controls, KeysWithoutTheirThingSaySo)
{
    EXPECT_FALSE(after({{'9'}}).message.empty());
    EXPECT_FALSE(after({{'P'}}).message.empty());
    EXPECT_FALSE(after({{'X'}}).message.empty());
    const auto messageOf = [](int key) {
        Session session;
        act(session, Choices{}, KeyPress{key});
        return session.message;
    };
    EXPECT_FALSE(messageOf(']').empty());
    EXPECT_FALSE(messageOf('W').empty());
}

TEST(Controls, ResetGoesBack)
{
    Session session = after({{'E'}, {'N'}, {'2'}, {' '}, {'W'}});
    pointLight(session, {0.5f, 0.1f});
    addLight(session);
    act(session, someChoices(), {'R'});
    EXPECT_EQ(session.state, opened().state);
    EXPECT_FALSE(session.playing);
}

TEST(Controls, TheWipeShowsTheNextMaterial)
{
    EXPECT_EQ(after({{'W'}}).state.wipe.material, "/m/gold.binary");
    EXPECT_EQ(after({{'2'}, {'W'}}).state.wipe.material, "lambert:0.5");
    EXPECT_EQ(after({{'3'}, {'W'}}).state.wipe.material, kSurface) << "the surface's own, by its name";
    EXPECT_EQ(after({{'W'}, {'W'}}).state.wipe, Wipe{});
}

TEST(Controls, LightsAreAddedMovedAndRemoved)
{
    Session session = opened();
    addLight(session);
    ASSERT_EQ(session.state.lights.size(), 2u);
    EXPECT_EQ(session.light, 1u);
    const LightSource first = session.state.lights[0];
    dragLight(session, {50, 0}, 720);
    EXPECT_EQ(session.state.lights[0], first) << "only the chosen one moves";
    removeLight(session);
    EXPECT_EQ(session.state.lights, std::vector<LightSource>{first});
    removeLight(session);
    EXPECT_EQ(session.state.lights.size(), 1u) << "something has to light the scene";
}

TEST(Controls, ARightDragFollowsTheMouse)
{
    Session session = opened(); // its light stands in front
    dragLight(session, {0, -90}, 720);
    EXPECT_NEAR(session.state.lights[0].direction.y, 0.5, 1e-5) << "up by half of a ball's radius: 180 pixels";
    EXPECT_NEAR(session.state.lights[0].direction.x, 0, 1e-6);
    EXPECT_EQ(session.state.lights[0].captured, 0);
}

TEST(Controls, TheLightPathIsOnceAround)
{
    Session session = after({{']'}});
    const glm::vec3 start = session.state.lights[0].direction;
    play(session, kSecondsAround / 4);
    EXPECT_LT(glm::distance(session.state.lights[0].direction, glm::vec3(0, 0.6f, 0.8f)), 1e-5f);
    play(session, 3 * kSecondsAround / 4);
    EXPECT_LT(glm::distance(session.state.lights[0].direction, start), 1e-5f);
}

} // namespace
} // namespace nacre
