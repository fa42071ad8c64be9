#!/usr/bin/env bash
# page_screenshot.sh PAGE: takes the picture of demo.html in docs/page.png, in Chromium with software WebGL.
set -euo pipefail
page=$(realpath "$1") work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$(dirname "$0")/.."
timeout 120 chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --no-first-run --user-data-dir="$work/profile" --host-resolver-rules='MAP * ~NOTFOUND' --hide-scrollbars \
    --window-size=1280,760 --virtual-time-budget=10000 --screenshot="$work/page.png" \
    "file://$page#photograph=2&compare=photograph" 2>/dev/null
oiiotool --nosoftwareattrib "$work/page.png" --ch R,G,B --resize:filter=lanczos3 960x570 -d uint8 --eraseattrib ".*" -o docs/page.png
