#pragma once
#include <span>

namespace nacre {

// What a key asks for. `material` carries the key's number.
enum class Action {
    help,
    material,
    target,
    brighter,
    darker,
    normals,
    coverage,
    labels,
    verdicts,
    residual,
    wipe,
    play,
    follow,
    reset,
    fit,
    previousPhotograph,
    nextPhotograph,
    photograph,
    difference,
    screenshot,
    undo,
    redo,
    larger,
    smaller,
    quit
};

// Key codes: ASCII for what prints (letters large), GLFW's numbers for the rest.
inline constexpr int kKeyEscape = 256, kKeyEnter = 257;
inline constexpr int kKeyF12 = 301;

enum class Held { any, none, shift, control, both, controlOrBoth }; // modifiers that a binding asks for

struct KeyBinding {
    int key;
    int lastKey; // of a run of keys
    Held held;
    Action action;
};

// One line of the help: every action has one, and its keys as they are written there.
struct ActionHelp {
    Action action;
    const char* keys;
    const char* text;
};

std::span<const KeyBinding> keyBindings();
std::span<const ActionHelp> actionHelp();

struct KeyPress {
    int key = 0;
    bool shift = false;
    bool control = false;
    bool isRepeat = false; // of a key that is held
};

// Null where the key means nothing.
const KeyBinding* bindingOf(const KeyPress& press);

} // namespace nacre
