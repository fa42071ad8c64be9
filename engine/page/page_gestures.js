// What pointers and the wheel do, as ways in CSS pixels, right and down.
"use strict";

// Calls move(event, right, down) with the way of each drag, in CSS pixels.
function watchDrags(target, begin, move) {
    let last = null;
    target.addEventListener("pointerdown", event => {
        target.setPointerCapture(event.pointerId);
        last = event;
        begin(event);
    });
    target.addEventListener("pointermove", event => {
        if (last && event.pointerId === last.pointerId) {
            move(event, event.clientX - last.clientX, event.clientY - last.clientY);
            last = event;
        }
    });
    for (const kind of ["pointerup", "pointercancel"]) {
        target.addEventListener(kind, () => {
            last = null;
        });
    }
}

// One finger or the left button drags, two fingers or the right button pan, two fingers or the wheel zoom about a point of
// the window.
function watchPicture(canvas, { drag, pan, zoom }) {
    const down = new Map();
    canvas.addEventListener("pointerdown", event => {
        canvas.setPointerCapture(event.pointerId);
        down.set(event.pointerId, event);
    });
    canvas.addEventListener("pointermove", event => {
        const last = down.get(event.pointerId);
        if (!last) {
            return;
        }
        const right = event.clientX - last.clientX, below = event.clientY - last.clientY;
        const other = [...down.values()].find(pointer => pointer.pointerId !== event.pointerId);
        down.set(event.pointerId, event);
        if (other) {
            const apart = pointer => Math.hypot(pointer.clientX - other.clientX, pointer.clientY - other.clientY);
            zoom(apart(event) / Math.max(apart(last), 1), (event.clientX + other.clientX) / 2,
                (event.clientY + other.clientY) / 2);
            pan(right / 2, below / 2);
        } else if (event.buttons & 2) {
            pan(right, below);
        } else {
            drag(right, below);
        }
    });
    for (const kind of ["pointerup", "pointercancel"]) {
        canvas.addEventListener(kind, event => down.delete(event.pointerId));
    }
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 16 : 1;
        zoom(2 ** (-lines * event.deltaY / 300), event.clientX, event.clientY);
    });
}
