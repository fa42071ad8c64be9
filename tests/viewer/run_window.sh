#!/usr/bin/env bash
# run_window.sh NACRE FOLDER: drives the window under Xvfb as a user does. Exit code 77, skipped: a tool is missing.
set -euo pipefail
nacre=$1 work=$2
. "$(dirname "$0")/../../scripts/window_driver.sh"
. "$(dirname "$0")/window_checks.sh"
require_window_tools
rm -rf "$work/shots"
shots=$work/shots
mkdir -p "$shots"
make_scene
export NACRE_VALIDATION=1
start_display 1280x720

# The capture's shadows are black but for its noise of 0.2 %; the fourth light casts some.
shadows_are_dark() {
    "$nacre" view "$work/bumpy.nacre" --capture "$work/capture" --light captured:4 --show verdicts --headless -o v.png
    mean_under() { # COLOUR: of the photograph, where the verdict is this
        convert v.png -fill black +opaque "$1" -fill white -opaque "$1" mask.png
        convert "$work/capture/object_04.png" mask.png -compose multiply -composite -format '%[fx:mean.r] ' info:
        convert mask.png -format '%[fx:mean.r]\n' info:
    }
    { mean_under '#598cff'; mean_under '#ebebeb'; } | tee means |
        awk '{ mean[NR] = $1 / $2; share[NR] = $2 } END { exit !(share[1] > 0.01 && mean[1] < 0.02 * mean[2]) }'
}

# The picture's area at 1280x720 is what the panels (250 left, 300 right) and the status line (26) leave.
picture=730x694+250+0
open_window "$work/bumpy.nacre" --capture "$work/capture" --size 730x694
screenshot; first=$shot
check_later "a screenshot's state gives its bytes again" reproduces "$first"
check "the screen shows it" screen_shows "$first" "$picture"

drag 1 1130 150 1100 130 1080 110 1160 100
screenshot; dragged=$shot
check "a drag on the ball moves the light" lacks "$dragged" captured:1
check_later "the dragged light's state gives its picture" reproduces "$dragged"
check "the screen shows the dragged light" screen_shows "$dragged" "$picture"
drag 3 600 340 560 300 500 420
screenshot
check "a right drag moves it anywhere" differs "$dragged" "$shot"
check_later "and its state gives the picture" reproduces "$shot"
press ctrl+z; screenshot
check "Ctrl+Z takes a whole drag back" cmp "$dragged" "$shot"
press ctrl+z; screenshot
check "and the one before it" cmp "$first" "$shot"
press ctrl+shift+z; screenshot
check "Ctrl+Shift+Z does it again" cmp "$dragged" "$shot"
press r; screenshot
check "R goes back" cmp "$first" "$shot"
xdotool mousemove 1090 297 sleep 1 click --repeat 2 --delay 180 1 sleep 1 type 45
sleep 0.7
xdotool key Return mousemove 640 340 sleep 0.7; screenshot # until then keys are text
check "a double click on the azimuth types it" awk -F'["",]+' '/"light"/ { getline; exit !($2 > 0.1 && $2 == $3) }' \
    "$(state_of "$shot")"
press r; screenshot
check "which R takes back" cmp "$first" "$shot"

drag 2 600 300 640 320 680 310; screenshot; turned=$shot
check "a middle drag turns a surface" holds "$shot" '"turn"'
check_later "as without a window" reproduces "$shot"
check "the screen shows it turned" screen_shows "$shot" "$picture"
press r; screenshot
check "turned back it has the same bytes" cmp "$first" "$shot"
xdotool mousemove 600 300 mousedown 2 mousemove 640 320 mousemove 680 310 mouseup 2 mousemove 300 600; screenshot
check "a drag ends where its button is let go" cmp "$turned" "$shot"
press r; screenshot

press e; screenshot; brighter=$shot
check "E exposes up" differs "$first" "$shot"
press shift+e; screenshot
check "Shift+E exposes down" cmp "$first" "$shot"
for view in n:normals l:labels c:coverage; do
    press "${view%%:*}"; screenshot
    check "${view%%:*} shows ${view##*:}" holds "$shot" "\"show\": \"${view##*:}\""
    check_later "${view##*:} again without a window" reproduces "$shot"
    press "${view%%:*}"
done
screenshot
check "twice is the picture again" cmp "$first" "$shot"
press bracketright; screenshot
check "] steps to the next captured light" holds "$shot" captured:2
press bracketleft; screenshot
check "[ steps back" holds "$shot" captured:1
settles render
for _ in $(seq 20); do # the photographs are read in the background
    press p
    changes render photograph 2 && break
done
check "P shows the photograph" differs "$work/render.png" "$work/photograph.png"
press x
check "X shows the difference" changes photograph difference 10
press x v; screenshot; verdicts=$shot
check "V shows verdicts" holds "$verdicts" '"show": "verdicts"'
check "the screen shows them" screen_shows "$verdicts" "$picture"
check_later "verdicts again without a window" reproduces_itself "$verdicts" --capture "$work/capture"
check_later "what it calls shadow is dark in the photograph" shadows_are_dark
check_later "verdicts need the photographs" refuses --capture view --state "$(state_of "$verdicts")" --headless -o none.png
check_later "which render has none of" refuses --capture render --state "$(state_of "$verdicts")" -o none.png
press bracketright; screenshot
check "] shows the next one's verdicts" differs "$verdicts" "$shot"
press r; screenshot # which comes after R was drawn
settles before
press h
check "H shows the help" changes before help 10
press question
check "? closes it" returns_to before after 10
press ctrl+equal
check "Ctrl++ makes text larger" changes before larger 10
press ctrl+minus
check "Ctrl+- undoes it" returns_to before after 10
press space; sleep 0.3; press space; screenshot
check "Space plays the light path" lacks "$shot" captured:1
press r
xdotool mousemove 600 300 click 4 click 4 click 4; sleep 0.1; screenshot
check "the wheel zooms" holds "$shot" '"zoom"'
drag 1 600 300 640 330; screenshot; panned=$shot
press f; screenshot
check "F fits" lacks "$shot" '"zoom"'
press ctrl+s
check "Ctrl+S writes a screenshot" wait_for_screenshot

for size in "900 600" "200 120" "1 1" "1280 720"; do
    xdotool windowsize --sync "$x_window" $size
    sleep 0.3
done
xdotool windowunmap --sync "$x_window"; sleep 0.2
xdotool windowmap --sync "$x_window"; sleep 0.3
xdotool windowfocus "$x_window"
screenshot
check "a picture after resizing and hiding" cmp "$first" "$shot"
check "Esc quits, without a message of Vulkan's validation" quits_quietly

shots=$work/shots2; rm -rf "$shots"; mkdir -p "$shots"
open_window "$work/bumpy.nacre" --onto "$work/bumpy.nacre" --light 0.3,0.4,0.8 --light=-0.5,0,0.8,0.2,0.4,1 \
    --state <(echo '{"format": "nacre scene", "version": 1, "window": {"materials": ["lambert:0.7,0.6,0.2"]}}')
press 2; screenshot
check "2 takes the second material" holds "$shot" '"material": "lambert:0.7,0.6,0.2"'
check_later "and its state gives the picture" reproduces "$shot"
press w; screenshot
check "W wipes to the next one" holds "$shot" wipe-material
check_later "a wipe's state gives its bytes again" reproduces_itself "$shot"
check "no message of Vulkan's validation with several materials" quits_quietly

shots=$work/shots3; rm -rf "$shots"; mkdir -p "$shots"
layered=$work/layered.nacre
[ -d "$layered" ] || "$nacre" acquire "$work/capture" -o "$layered" --quiet --normals least-squares --residual difference
open_window "$layered" --capture "$work/capture" --size 730x694
screenshot; layer=$shot
check "a state says nothing of the residual layer where it is on" lacks "$layer" residual
for use in off alone; do
    press d; screenshot
    check "D turns the residual layer $use" holds "$shot" "\"layer\": \"$use\""
    check "which is another picture" differs "$layer" "$shot"
    check_later "and is the same without a window" reproduces "$shot"
done
check "the screen shows the layer alone" screen_shows "$shot" "$picture"
press d; screenshot
check "D turns it on again" cmp "$layer" "$shot"
check "no message of Vulkan's validation with a residual layer" quits_quietly

for fitted in 365x347:2 1460x1388:0.5; do
    shots=$work/shots${fitted##*:}; rm -rf "$shots"; mkdir -p "$shots"
    open_window "$work/bumpy.nacre" --size "${fitted%%:*}"
    screenshot
    "$nacre" render --state "$(state_of "$shot")" --scale "${fitted##*:}" -o "$work/scaled.png" --quiet --force
    check "${fitted%%:*} is seen as render --scale ${fitted##*:} makes it" screen_shows "$work/scaled.png" "$picture"
    check "no message of Vulkan's validation there" quits_quietly
done

shots=$work/shots4; rm -rf "$shots"; mkdir -p "$shots"
open_window --size 128x128
screenshot
check "without arguments a material is on a head" holds "$shot" '"onto": "make:head"'
check_later "and its state gives the picture" reproduces "$shot"
first=$shot
settles before
press t; screenshot
check "T steps through the generated shapes" holds "$shot" '"onto": "make:sphere"'
for _ in $(seq 4); do press t; screenshot; done
check "and comes back to the first" cmp "$first" "$shot"
settles after
check "which shapes that were shown have thumbnails beside" differs "$work/before.png" "$work/after.png"
check "no message of Vulkan's validation with generated shapes" quits_quietly

shots=$work/shots5; rm -rf "$shots"; mkdir -p "$shots"
printf 'v %s\n' '0 0 1' '1 0 -1' '-1 1 -1' '-1 -1 -1' >"$work/pyramid.obj"
printf 'f %s\n' '1 2 3' '1 3 4' '1 4 2' '2 4 3' >>"$work/pyramid.obj"
open_window --onto "$work/pyramid.obj" --size 730x694
screenshot; still=$shot
drag 2 600 300 640 320 680 310; screenshot
check "a middle drag turns a mesh" holds "$shot" '"turn"'
check_later "and its state gives the picture" reproduces "$shot"
press o; screenshot # which comes after O: what the mouse does in a busy window's same moment would come before
drag 2 600 300 580 300 560 300; screenshot
check "O turns lights with it" differs_in_light "$still" "$shot"
press r; screenshot
check "turned back it has the same bytes" cmp "$still" "$shot"
xdotool mousemove 600 300 mousedown 2 mousemove 610 310 sleep 0.1 mousemove 640 320 sleep 0.1 mousemove 680 310
screenshot; held=$shot
check_later "a screenshot is full while a mesh is turned" reproduces "$held"
check "and so is the screen, once the mouse is still" screen_shows "$held" "$picture"
xdotool mouseup 2; screenshot
check "it stays so once the mesh is let go" cmp "$held" "$shot"
press r; screenshot
check "and has the first bytes again" cmp "$still" "$shot"
check "no message of Vulkan's validation with a mesh" quits_quietly

shots=$work/shots6; rm -rf "$shots"; mkdir -p "$shots"
open_window --onto make:sphere --material 'ggx:diffuse=0.1;specular=0.5;alpha=0.02' --size 320x320
xdotool mousemove 600 340 mousedown 3 mousemove 580 330 sleep 0.1 mousemove 560 300 sleep 0.1 mousemove 520 320
screenshot; held=$shot
check_later "a screenshot is full while a sharp highlight is dragged" reproduces "$held"
xdotool mouseup 3; screenshot
check "and the same once it is let go" cmp "$held" "$shot"
check "no message of Vulkan's validation with a sharp highlight" quits_quietly

unset DISPLAY
code=0; "$nacre" view "$work/bumpy.nacre" 2>"$work/err" || code=$?
check "without a display it says so" test "$code" = 3
check "and names --headless" grep -q -- --headless "$work/err"
finish_checks
exit $((failures > 0))
