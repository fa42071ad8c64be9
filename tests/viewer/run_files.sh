#!/usr/bin/env bash
# run_files.sh NACRE FOLDER XDND_SOURCE SET_DENSITY: drops files on the window under Xvfb as a file manager does, cancels
# what loads, turns an environment, and opens the window on a screen of 192 dots an inch. Exit code 77, skipped: a tool is
# missing.
set -euo pipefail
[ $# = 4 ] || { echo "needs libx11-dev (apt.txt)"; exit 77; }
nacre=$1 work=$2 xdnd_source=$3 set_density=$4
. "$(dirname "$0")/../../scripts/window_driver.sh"
. "$(dirname "$0")/window_checks.sh"
require_window_tools oiiotool
rm -rf "$work/shots"
shots=$work/shots files=$work/files
mkdir -p "$shots" "$files"
make_scene
picture=730x694+250+0 status=980x26+0+694
export NACRE_VALIDATION=1

cp "$work/bumpy.nacre/material_0.exr" "$files/paint.exr"
cp "$work/bumpy.nacre/normals.exr" "$files/a shape.exr"
cp -r "$work/bumpy.nacre" "$files/other.nacre"
head -c 20000 "$work/bumpy.nacre/normals.exr" >"$files/broken.exr"
echo "no table" >"$files/broken.binary"
mkdir -p "$files/broken.nacre" && echo '{"format"' >"$files/broken.nacre/surface.json" && touch "$files/broken.nacre/material_0.exr"
oiiotool --pattern constant:color=0.3,0.35,0.4 128x64 3 --fill:color=30,28,22 8x8+30+18 -o "$files/sky.hdr"
[ -e "$files/big.png" ] || oiiotool --pattern constant:color=0.5,0.5,1 4096x4096 3 -d uint16 --compression none -o "$files/big.png"

drop() { "$xdnd_source" "$x_window" "$files/$1"; }
keep_status() { import -window root -crop "$status" "$work/$1.png"; }
# Waits until the status line is another than it was kept.
status_changes() {
    for _ in $(seq 100); do
        keep_status status-after
        cmp -s "$work/status.png" "$work/status-after.png" || return 0
        sleep 0.02
    done
    return 1
}

start_display 1280x720
open_window "$work/bumpy.nacre" --size 730x694
screenshot; first=$shot
for broken in broken.exr broken.binary broken.nacre; do
    keep_status status
    check "$broken is taken" drop "$broken"
    check "and said to be none" status_changes
    screenshot
    check "the old picture stays" cmp "$first" "$shot"
    check "and the old state" cmp "$(state_of "$first")" "$(state_of "$shot")"
done
keep_status status
drop big.png
status_changes # to its progress
xdotool mousemove 30 707 click 1
screenshot
check "a load that is cancelled leaves the picture" cmp "$first" "$shot"
check "and the state" cmp "$(state_of "$first")" "$(state_of "$shot")"

drop "a shape.exr"; screenshot
check "a normal map is the shape" holds "$shot" '"onto": "../files/a shape.exr"'
check_later "and its state gives the picture" reproduces "$shot"
drop paint.exr; screenshot
check "a table is the material" holds "$shot" 'files/paint.exr"'
check_later "with the shape as it was" reproduces "$shot"
drop sky.hdr; screenshot
check "a picture of the sky is the environment" holds "$shot" '"environment": "../files/sky.hdr"'
check "the screen shows it" screen_shows "$shot" "$picture"
check_later "as without a window" reproduces "$shot"
straight=$shot
drag 1 1080 306 1120 306 1140 306; screenshot
check "its slider turns it" differs "$straight" "$shot"
check "and the state says how far" lacks "$shot" '"environment-turn": 0.0'
check "the screen shows it turned" screen_shows "$shot" "$picture"
check_later "turned as without a window" reproduces "$shot"
drop other.nacre; screenshot
check "a surface takes the place of all" holds "$shot" '"surface": "../files/other.nacre"'
check_later "and is the picture that it was" reproduces "$shot"
check "no message of Vulkan's validation about files" quits_quietly
stop_display

# The same layout on twice the pixels: the picture twice as large, the same place on the ball the same light.
directions() { sed -n '/"light"/,/\]/s/^ *"\([^"]*\)",*$/\1/p' "$(state_of "$1")"; }
start_display 2560x1440
"$set_density" 192
open_window "$work/bumpy.nacre" --size 730x694
screenshot
"$nacre" render --state "$(state_of "$shot")" --scale 2 -o "$work/twice.png" --quiet --force
check "at 192 dots an inch panels take twice the pixels" screen_shows "$work/twice.png" 1460x1388+500+0
drag 1 2260 300 2200 260 2160 220; screenshot
far=$(directions "$shot")
check "no message of Vulkan's validation at 192 dots an inch" quits_quietly
stop_display
start_display 2560x1440
open_window "$work/bumpy.nacre" --size 730x694 --ui-scale 2
xdotool windowsize --sync "$x_window" 2560 1440
settles resized
drag 1 2260 300 2200 260 2160 220; screenshot
check "--ui-scale 2 looks as 192 dots an inch do" test "$(directions "$shot")" = "$far"
check "and quits" quits_quietly
stop_display
start_display 1280x720
open_window "$work/bumpy.nacre" --size 730x694
drag 1 1130 150 1100 130 1080 110; screenshot
near=$(directions "$shot")
echo "      light $near, at 192 dots an inch $far"
# Text is not exactly twice as high, which moves the ball by a pixel or two of its 400.
check "the ball takes the mouse at either density" awk -v a="$near" -v b="$far" 'BEGIN {
    split(a, p, ","); split(b, q, ","); for (i = 1; i <= 3; ++i) off += (p[i] - q[i]) ^ 2; exit !(off < 0.02 ^ 2 && p[1] < 0) }'
check "and all of it quits" quits_quietly
finish_checks
exit $((failures > 0))
