#pragma once
#include "engine/view_state/choices.h"
#include "engine/view_state/framing.h"
#include "engine/view_state/key_table.h"
#include "engine/view_state/light_history.h"

namespace nacre {

// What stands beside or in place of the render.
enum class Comparison { none, photograph, difference };

// What the user has done to a window; pure data, so that mouse and keys are tested without one.
struct Session {
    ViewState state;
    ViewState opened; // what R goes back to
    LightHistory history;
    size_t light = 0; // of state.lights, that drags move
    float textScale = 1;
    bool help = false;
    bool playing = false;
    Comparison comparison = Comparison::none;
    std::optional<size_t> photograph; // of the captured ones, that was stepped to
    bool hasPhotographs = false;      // pictures of the captured lights are at hand
    bool canTurn = false;             // what is drawn lies on a mesh
    bool lightsFollow = false;        // the object, where it is turned
    bool hasResidual = false;         // what is drawn has a residual layer, seen from the front
    std::string message;              // to the user, about what was asked for last
    bool wantsScreenshot = false;
    std::filesystem::path wantsToOpen{}; // another surface; empty: none
    bool wantsToQuit = false;
};

inline constexpr float kTurnOfDrag = 0.25f;   // degrees a pixel; exact in sums, so that a way back is one
inline constexpr float kExposureStep = 0.25f; // stops
inline constexpr float kLeastTextScale = 0.5f, kMostTextScale = 4, kTextStep = 1.25f;
inline constexpr float kSecondsAround = 8;        // of the light path
inline constexpr float kDistanceStep = 1.189207f; // two to the fourth part of one
inline constexpr float kFarthestChosen = 16;      // widths of the object
inline constexpr float kBallRadiusOfDrag = 0.25f; // radius of the ball that a right-drag turns, of the window's height

// What a key does. Keys whose thing is not there do nothing but say so.
void act(Session& session, const Choices& choices, const KeyPress& press);
void act(Session& session, const Choices& choices, Action action, size_t number = 0);

void chooseMaterial(Session& session, const Choices& choices, size_t material);
void chooseTarget(Session& session, const Choices& choices, size_t target);
void chooseWipe(Session& session, const Choices& choices, size_t material);

// In place of all lights; none: a light of one's own.
void chooseEnvironment(Session& session, const Choices& choices, std::optional<size_t> environment);

// The light stands at the captured one's place and strength, alone.
void showCapturedLight(Session& session, const Choices& choices, size_t index);

// The chosen light goes where the cursor is on a light ball (see light_ball.h).
void pointLight(Session& session, const glm::vec2& disc);
// Drags in screen pixels, y down, in a window so many pixels high.
void dragLight(Session& session, const glm::vec2& moved, float windowHeight);
// The wheel over the light ball: a step of 1 takes the chosen light away by kDistanceStep, steps below 0 bring it
// nearer. Beyond kFarthestChosen it is distant.
void pushLight(Session& session, float steps);
// A drag by so many units of layout, y down, turns what can be turned: its front goes with the cursor, and so do lights
// that follow it; an environment stays.
void turnObject(Session& session, const glm::vec2& moved);
void addLight(Session& session);
void removeLight(Session& session); // the chosen one, unless nothing would light the scene

void chooseResidual(Session& session, ResidualUse use);

// Verdicts are on one photograph: where the state has come to show none, the picture comes back; and so it does from a
// residual layer by itself, where what is drawn has none.
void settleShow(Session& session);

// Time passes while the light path plays: lights turn about the viewing axis.
void play(Session& session, float seconds);

} // namespace nacre
