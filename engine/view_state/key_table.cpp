#include "engine/view_state/key_table.h"

#include <array>

namespace nacre {

namespace {

constexpr std::array kBindings = {KeyBinding{'H', 'H', Held::none, Action::help},
                                  KeyBinding{'/', '/', Held::shift, Action::help}, // ? on most keyboards
                                  KeyBinding{'?', '?', Held::any, Action::help},
                                  KeyBinding{'1', '9', Held::none, Action::material},
                                  KeyBinding{'T', 'T', Held::none, Action::target},
                                  KeyBinding{'E', 'E', Held::none, Action::brighter},
                                  KeyBinding{'E', 'E', Held::shift, Action::darker},
                                  KeyBinding{'N', 'N', Held::none, Action::normals},
                                  KeyBinding{'C', 'C', Held::none, Action::coverage},
                                  KeyBinding{'L', 'L', Held::none, Action::labels},
                                  KeyBinding{'V', 'V', Held::none, Action::verdicts},
                                  KeyBinding{'D', 'D', Held::none, Action::residual},
                                  KeyBinding{'W', 'W', Held::none, Action::wipe},
                                  KeyBinding{' ', ' ', Held::none, Action::play},
                                  KeyBinding{'O', 'O', Held::none, Action::follow},
                                  KeyBinding{'R', 'R', Held::none, Action::reset},
                                  KeyBinding{'F', 'F', Held::none, Action::fit},
                                  KeyBinding{'[', '[', Held::none, Action::previousPhotograph},
                                  KeyBinding{']', ']', Held::none, Action::nextPhotograph},
                                  KeyBinding{'P', 'P', Held::none, Action::photograph},
                                  KeyBinding{'X', 'X', Held::none, Action::difference},
                                  KeyBinding{'S', 'S', Held::control, Action::screenshot},
                                  KeyBinding{kKeyF12, kKeyF12, Held::any, Action::screenshot},
                                  KeyBinding{'Z', 'Z', Held::control, Action::undo},
                                  KeyBinding{'Z', 'Z', Held::both, Action::redo},
                                  KeyBinding{'=', '=', Held::controlOrBoth, Action::larger}, // + on many keyboards
                                  KeyBinding{'+', '+', Held::controlOrBoth, Action::larger},
                                  KeyBinding{'-', '-', Held::control, Action::smaller},
                                  KeyBinding{kKeyEscape, kKeyEscape, Held::any, Action::quit}};

constexpr std::array kHelp = {ActionHelp{Action::help, "H or ?", "this help"},
                              ActionHelp{Action::material, "1 to 9", "material by its number in the list"},
                              ActionHelp{Action::target, "T", "next shape in the list"},
                              ActionHelp{Action::brighter, "E", "exposure up by a quarter of a stop"},
                              ActionHelp{Action::darker, "Shift+E", "exposure down by a quarter of a stop"},
                              ActionHelp{Action::normals, "N", "normals / picture"},
                              ActionHelp{Action::coverage, "C", "stripes where uncertain by over 20 %"},
                              ActionHelp{Action::labels, "L", "material labels / picture"},
                              ActionHelp{Action::verdicts, "V", "verdicts on the photograph (with the capture)"},
                              ActionHelp{Action::residual, "D", "what the BRDF does not explain: on, off, alone"},
                              ActionHelp{Action::wipe, "W", "wipe to the next material; drag its line"},
                              ActionHelp{Action::play, "Space", "play the light path: once around in 8 seconds"},
                              ActionHelp{Action::follow, "O", "lights turn with the object / stay with the camera"},
                              ActionHelp{Action::reset, "R", "back to how the window opened"},
                              ActionHelp{Action::fit, "F", "fit the picture into the window"},
                              ActionHelp{Action::previousPhotograph, "[", "captured light before this one"},
                              ActionHelp{Action::nextPhotograph, "]", "captured light after this one"},
                              ActionHelp{Action::photograph, "P", "photograph / render (with the capture)"},
                              ActionHelp{Action::difference, "X", "photograph minus render (with the capture)"},
                              ActionHelp{Action::screenshot, "Ctrl+S or F12", "screenshot and its state file"},
                              ActionHelp{Action::undo, "Ctrl+Z", "lights as they were before"},
                              ActionHelp{Action::redo, "Ctrl+Shift+Z", "and as they were after"},
                              ActionHelp{Action::larger, "Ctrl++", "larger text"},
                              ActionHelp{Action::smaller, "Ctrl+-", "smaller text"},
                              ActionHelp{Action::quit, "Esc", "close this help, or quit"}};

bool fits(const KeyBinding& binding, const KeyPress& press)
{
    if (press.key < binding.key || press.key > binding.lastKey) {
        return false;
    }
    switch (binding.held) {
    case Held::any:
        return true;
    case Held::none:
        return !press.shift && !press.control;
    case Held::shift:
        return press.shift && !press.control;
    case Held::control:
        return press.control && !press.shift;
    case Held::both:
        return press.control && press.shift;
    case Held::controlOrBoth:
        return press.control;
    }
    return false;
}

} // namespace

std::span<const KeyBinding> keyBindings()
{
    return kBindings;
}

std::span<const ActionHelp> actionHelp()
{
    return kHelp;
}

const KeyBinding* bindingOf(const KeyPress& press)
{
    for (const KeyBinding& binding : kBindings) {
        if (fits(binding, press)) {
            return &binding;
        }
    }
    return nullptr;
}

} // namespace nacre
