#!/usr/bin/env bash
# viewer_figures.sh [NACRE [MESH]]: frames a second in a window of 1280x720 while one of four lights is dragged, or a mesh
# is turned under them, and what share of a core the window takes when nothing moves. Prints the figures of the window in
# docs/results.md.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/window_driver.sh
set_stage "${1:-build/release/app/nacre}"
flat=$work/flat.json # cast shadows are drawn directly, others from balls
echo '{"format": "nacre scene", "version": 1, "shadows": false}' >"$flat"
lights=(--light 0.3,0.4,0.87 --light=-0.6,0.2,0.8,0.3,0.5,1 --light 0.5,-0.5,0.7,0.8,0.6,0.3 --light=0,0.7,0.7,0.2,0.2,0.2)

ticks() { awk '{ print $14 + $15 }' "/proc/$window_id/stat"; } # hundredths of a second of one core

# Drags for about so many seconds, quits, and prints how many pictures the window showed since it opened, the
# processor's time that it took, and how many seconds the drag took.
pictures_after() { # SECONDS
    open_window --size "$size" "${lights[@]}" "${shown[@]}"
    sleep 3
    local began=$EPOCHREALTIME
    if [ "$1" -gt 0 ]; then
        xdotool mousemove $((from_x + 16)) "$from_y" mousedown "$button"
        local moves=() end=$((SECONDS + $1)) # one call for many moves: starting it takes longer than a frame
        for s in 0 2 4 6 8 10 12 14 16 18 20 22 24 26 28 26 24 22 20 18 16 14 12 10 8 6 4 2; do
            moves+=(mousemove $((from_x + s)) $((from_y + s)) sleep 0.008)
        done
        while [ $SECONDS -lt $end ]; do xdotool "${moves[@]}" "${moves[@]}"; done
        title=$(xdotool getwindowname "$x_window")
        echo "            ${title##* - }" >&2
        xdotool mouseup "$button"
    fi
    local ended=$EPOCHREALTIME busy
    busy=$(ticks)
    press Escape
    wait "$window_id"
    window_id=
    awk -v b="$busy" -v from="$began" -v to="$ended" '/^showed/ { print $2, b, to - from }' "$work/out"
}

seconds=8
measure() { # WHAT SIZE WORDS ARGUMENTS of nacre view
    size=$2 shown=("${@:4}")
    local start=$(pictures_after 0) moved=$(pictures_after $seconds)
    echo "$start $moved" | awk -v z="$2$3" -v w="$1" '{ n = $4 - $1
        printf "%-11s %.0f frames a second, %.0f ms of processor time each, %s\n", w, n / $6, 10 * ($5 - $2) / n, z }'
}
drag_light() { # SIZE WORDS ARGUMENTS
    from_x=1100 from_y=100 button=1 # on the light ball
    measure dragging "$@"
}
for size in 320x320 730x694 1280x720; do
    drag_light "$size" "" "$work/bumpy.nacre" --state "$flat"
done
drag_light 730x694 " with cast shadows" "$work/bumpy.nacre"
drag_light 730x694 " under a sharp highlight" --onto make:sphere --material 'ggx:diffuse=0.1;specular=0.5;alpha=0.02'
if [ $# -gt 1 ]; then
    from_x=620 from_y=400 button=2
    measure turning 1024x1024 " of ${2##*/}" --onto "$2" --material 'ggx:diffuse=0.5,0.2,0.1;specular=0.05;alpha=0.15'
fi
"$nacre" bench --size 1280x720 --lights 4 --residual-components 0 --most-direct-lights 1 | grep -m 2 'ball' # wall time

open_window --size 730x694 "${lights[@]}" "$work/bumpy.nacre" --state "$flat"
sleep 10 # until the opening hint has gone
idle=10
before=$(ticks); sleep $idle; after=$(ticks)
awk -v t=$((after - before)) -v s=$idle 'BEGIN { printf "idle        %.1f %% of one core over %d s\n", t / s, s }'
