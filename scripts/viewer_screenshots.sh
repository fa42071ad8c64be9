#!/usr/bin/env bash
# viewer_screenshots.sh [NACRE]: takes the pictures of the window in docs/viewer-*.png under Xvfb.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/window_driver.sh
set_stage "${1:-build/release/app/nacre}"
take() { sleep 1; import -window root "docs/viewer-$1.png"; echo "docs/viewer-$1.png"; }

cat >"$work/state.json" <<END
{"format": "nacre scene", "version": 1, "surface": "bumpy.nacre", "light": ["-0.45,0.4,0.8", "0.9,-0.1,0.4,0.25,0.4,0.9"],
 "window": {"materials": ["ggx:diffuse=0.02,0.015,0.01;specular=0.9,0.6,0.3;alpha=0.25", "lambert:0.6,0.65,0.7"]}}
END
open_window --state "$work/state.json" --capture "$work/capture"
sleep 4 # thumbnails and photographs
take window
press bracketright bracketright bracketright p x; take difference
press x v; take verdicts
press v Escape
wait "$window_id"
window_id=
