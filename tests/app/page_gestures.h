#pragma once
#include <string>

namespace nacre::test {

// A script's function gestures(window, page): what it answers is how far the light moved, how often the picture grew by
// a pinch and by the wheel, how many lights there are and what is shown after two keys.
inline const std::string kGestures = R"(// What a drag, a pinch, the wheel and two keys do.
function gestures(inside, page) {
    const { canvas } = page, before = page.light.direction, told = [];
    canvas.setPointerCapture = () => {}; // of pointers that no device has
    page.choose({ zoom: 0 });
    page.draw();
    const point = (kind, pointerId, clientX) =>
        canvas.dispatchEvent(new inside.PointerEvent(kind, { pointerId, clientX, clientY: 100, buttons: 1 }));
    const grown = act => {
        const scale = page.frame.scale;
        act();
        told.push((page.frame.scale / scale).toFixed(2));
    };
    point("pointerdown", 1, 100);
    point("pointermove", 1, 130);
    told.push(page.light.direction[0] > before[0] ? "moved" : "still");
    grown(() => {
        point("pointerdown", 2, 230);
        point("pointermove", 2, 330);
        point("pointerup", 1, 130);
        point("pointerup", 2, 330);
    });
    grown(() => canvas.dispatchEvent(new inside.WheelEvent("wheel", { deltaY: 300, cancelable: true })));
    for (const key of ["l", "n"]) {
        canvas.dispatchEvent(new inside.KeyboardEvent("keydown", { key, bubbles: true }));
    }
    return `${told.join(" ")} ${page.state.lights.length} ${page.state.show}`;
}
)";

} // namespace nacre::test
