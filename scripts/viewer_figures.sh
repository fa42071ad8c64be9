#!/usr/bin/env bash
# viewer_figures.sh [NACRE]: frames a second while a light is dragged (four lights, the surface fills a window of
# 1280x720), and what share of a core the window takes when nothing moves. Prints the table of docs/viewer.md.
set -euo pipefail
cd "$(dirname "$0")/.."
nacre=$(realpath "${1:-build/release/app/nacre}")
work=$(mktemp -d)
shots=$work/shots
. scripts/window_driver.sh
require_window_tools
mkdir -p "$shots"
make_scene
start_display 1280x720
open_window "$work/bumpy.nacre" --size 730x694 --light 0.3,0.4,0.87 --light=-0.6,0.2,0.8,0.3,0.5,1 \
    --light 0.5,-0.5,0.7,0.8,0.6,0.3 --light=0,0.7,0.7,0.2,0.2,0.2
sleep 4

ticks() { awk '{ print $14 + $15 }' "/proc/$window_id/stat"; } # hundredths of a second of one core
idle=10
before=$(ticks); sleep $idle; after=$(ticks)
awk -v t=$((after - before)) -v s=$idle 'BEGIN { printf "idle        %.1f %% of one core over %d s\n", t / s, s }'

# Frames that were presented, as the program's own log of them counts.
seconds=6
kill -USR1 "$window_id"; sleep 0.1
xdotool mousemove 1130 110 mousedown 1
end=$((SECONDS + seconds))
while [ $SECONDS -lt $end ]; do
    for step in 0 4 8 12 16 20 24 28 24 20 16 12 8 4; do xdotool mousemove $((1116 + step)) $((100 + step)); done
done
xdotool mouseup 1
