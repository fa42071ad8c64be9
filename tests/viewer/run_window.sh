#!/usr/bin/env bash
# run_window.sh NACRE FOLDER: drives the window under Xvfb as a user does. Exit code 77, skipped: a tool is missing.
set -euo pipefail
nacre=$1 work=$2
. "$(dirname "$0")/../../scripts/window_driver.sh"
require_window_tools
rm -rf "$work/shots" "$work/display"
shots=$work/shots
mkdir -p "$shots"
make_scene
export NACRE_VALIDATION=1
start_display 1280x720

failures=0
check() { # NAME COMMAND...
    local name=$1
    shift
    if "$@"; then echo "ok    $name"; else echo "FAIL  $name"; failures=$((failures + 1)); fi
}
holds() { grep -qF -- "$2" "${1%.png}.json"; }
lacks() { ! holds "$@"; }
differs() { ! cmp -s "$1" "$2"; }
grab() { import -window root "$work/$1.png"; }
# Waits until the screen is another than BEFORE.png, and keeps it as AFTER.png.
changes() { # BEFORE AFTER SECONDS
    for _ in $(seq $((4 * $3))); do
        sleep 0.25
        grab "$2"
        cmp -s "$work/$1.png" "$work/$2.png" || return 0
    done
    return 1
}
# The same state without a window: the picture and its metadata byte for byte, and what nacre render makes of it.
reproduces() {
    "$nacre" view --state "${1%.png}.json" --headless -o "$shots/again.png"
    local same=0
    cmp "$1" "$shots/again.png" && cmp "${1%.png}.json" "$shots/again.json" || same=1
    "$nacre" render --state "${1%.png}.json" -o "$work/render.png" --quiet --force
    local off
    off=$(compare -metric AE "$1" "$work/render.png" null: 2>&1 || true)
    rm -f "$shots/again.png" "$shots/again.json"
    [ "$same" = 0 ] && [ "$off" = 0 ]
}
# What is on the screen against the screenshot, where the picture stands unscaled. Largest difference in 8-bit codes.
screen_shows() {
    local off
    import -window root -crop "${picture}+${left}+${top}" +repage "$work/screen.png"
    off=$(compare -metric PAE "$work/screen.png" "$1" null: 2>&1 || true)
    echo "      screen against state: $off"
    awk -v text="$off" 'BEGIN { gsub(/[()]/, "", text); split(text, part, " "); exit !(part[2] * 255 <= 1.01) }'
}

# The picture's area at 1280x720 is what the panels (250 left, 300 right) and the status line (26) leave.
picture=730x694 left=250 top=0
open_window "$work/bumpy.nacre" --capture "$work/capture" --size 730x694
screenshot; first=$shot
check "a screenshot's state gives its bytes again" reproduces "$first"
check "the screen shows it" screen_shows "$first"

drag 1 1130 150 1100 130 1080 110 1160 100
screenshot; dragged=$shot
check "a drag on the ball moves the light" lacks "$dragged" captured:1
check "the dragged light's state gives its picture" reproduces "$dragged"
check "the screen shows the dragged light" screen_shows "$dragged"
drag 3 600 340 560 300 500 420
screenshot
check "a right drag moves it anywhere" differs "$dragged" "$shot"
check "and its state gives the picture" reproduces "$shot"
press r; screenshot
check "R goes back" cmp "$first" "$shot"

press e; screenshot; brighter=$shot
check "E exposes up" differs "$first" "$shot"
press shift+e; screenshot
check "Shift+E exposes down" cmp "$first" "$shot"
for view in n:normals l:labels c:coverage; do
    press "${view%%:*}"; screenshot
    check "${view%%:*} shows ${view##*:}" holds "$shot" "\"show\": \"${view##*:}\""
    check "${view##*:} again without a window" reproduces "$shot"
    press "${view%%:*}"
done
screenshot
check "twice is the picture again" cmp "$first" "$shot"
press bracketright bracketright; screenshot
check "] steps to the next captured light" holds "$shot" captured:2
press bracketleft; screenshot
check "[ steps back" holds "$shot" captured:1
sleep 1; grab render
for _ in $(seq 20); do # the photographs are read in the background
    press p
    changes render photograph 2 && break
done
check "P shows the photograph" differs "$work/render.png" "$work/photograph.png"
press x
check "X shows the difference" changes photograph difference 10
press x r; sleep 1
grab before; press h
check "H shows the help" changes before help 10
press question
changes help after 10 || true; sleep 1; grab after
check "? closes it" cmp -s "$work/before.png" "$work/after.png"
press space; sleep 0.7; press space; screenshot
check "Space plays the light path" lacks "$shot" captured:1
press r
xdotool mousemove 600 300 click 4 click 4 click 4; sleep 0.3; screenshot
check "the wheel zooms" holds "$shot" '"zoom"'
drag 1 600 300 640 330; screenshot; panned=$shot
press f; screenshot
check "F fits" lacks "$shot" '"zoom"'
press ctrl+s; sleep 0.5
check "Ctrl+S writes a screenshot" test -e "$(printf '%s/nacre-%04d.png' "$shots" $(($(ls "$shots"/*.png | wc -l))))"

for size in "900 600" "200 120" "1 1" "1280 720"; do
    xdotool windowsize --sync "$x_window" $size
    sleep 0.4
done
xdotool windowunmap "$x_window"; sleep 0.4
xdotool windowmap "$x_window"; sleep 0.8
xdotool windowfocus "$x_window"
screenshot
check "a picture after resizing and hiding" cmp "$first" "$shot"
press Escape
code=0; wait "$window_id" || code=$?
window_id=
check "Esc quits" test "$code" = 0
check "no message of Vulkan's validation" test ! -s "$work/err"
cat "$work/err"

shots=$work/shots2; rm -rf "$shots"; mkdir -p "$shots"
open_window "$work/bumpy.nacre" --onto "$work/bumpy.nacre" --light 0.3,0.4,0.8 --light=-0.5,0,0.8,0.2,0.4,1 \
    --state <(echo '{"format": "nacre scene", "version": 1, "window": {"materials": ["lambert:0.7,0.6,0.2"]}}')
press 2; sleep 2; screenshot
check "2 takes the second material" holds "$shot" '"material": "lambert:0.7,0.6,0.2"'
check "and its state gives the picture" reproduces "$shot"
press w; sleep 2; screenshot
check "W wipes to the next one" holds "$shot" wipe-material
"$nacre" view --state "${shot%.png}.json" --headless -o "$shots/again.png"
check "a wipe's state gives its bytes again" cmp "$shot" "$shots/again.png"
xdotool windowclose "$x_window" 2>/dev/null || true
kill "$window_id" 2>/dev/null || true
wait "$window_id" 2>/dev/null || true
window_id=
check "no message of Vulkan's validation with several materials" test ! -s "$work/err"

unset DISPLAY
code=0; "$nacre" view "$work/bumpy.nacre" 2>"$work/err" || code=$?
check "without a display it says so" test "$code" = 3
check "and names --headless" grep -q -- --headless "$work/err"
exit $((failures > 0))
