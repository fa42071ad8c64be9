#!/usr/bin/env bash
# check_device.sh [DEVICE]: whether a Vulkan device draws what it should, and how fast. DEVICE: a number or a part of its
# name, as --device takes it (default: the best). Prints one text: driver, limits, tests, frames; ends with passed or
# FAILED. BUILD (default: build/release) holds the program and its tests.
#   scripts/check_device.sh nvidia > device.txt
# Goldens are held to the same bounds on every device (tests/gpu/golden_match.cpp); radiance to 1e-3 of its value, 32 times
# that where the filter has 8 bits (tests/gpu/frame_match.cpp).
set -uo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build/release}
nacre=$build/app/nacre tests=$build/tests/nacre_system_tests
for program in "$nacre" "$tests" "${tests%system_tests}target_tests"; do
    [ -x "$program" ] || { echo "needs $program" >&2; exit 3; }
done
export NACRE_DEVICE=${1:-} NACRE_VALIDATION=1
failed=0

echo "nacre        $("$nacre" --version)"
echo "machine      $(uname -srm), $(nproc) cores"
"$nacre" info || exit 3
echo "validation   of Vulkan's calls, in the tests"
"$nacre" bench --size 16x16 --lights 1 --repeats 1 --residual-components 0 >/dev/null || exit 3 # says why it cannot draw

# Suites that draw; each in a process of its own, so that one that dies does not hide the rest.
check_suites() { # PROGRAM FILTER
    local suite log
    for suite in $("$1" --gtest_list_tests --gtest_filter="$2" | sed -n 's/^\([A-Za-z/]*\)\..*/\1/p' | sort -u); do
        if log=$("$1" --gtest_filter="$suite.*" --gtest_brief=1 2>&1); then
            printf 'tests        %-28s passed\n' "$suite"
        else
            printf 'tests        %-28s FAILED\n' "$suite"
            grep -E '^\[  FAILED|Failure|beyond the bound|off by more|vulkan validation' <<<"$log" | head -n 20 | sed 's/^/    /'
            failed=1
        fi
    done
}
check_suites "$tests" 'Ball*:CapturedMaterial*:Device*:Extremes*:FalseColour*:Frame*:*Golden.*:NearLight*:ResidualTest*:Shadow*:Zoom*'
check_suites "${tests%system_tests}target_tests" 'MeshRaster*:Relief*'
"$tests" --gtest_filter='Kept/Golden.IsDrawn/*' --gtest_brief=1 2>&1 | sed -n 's/^  \([a-z_]*: [0-9].*\)/golden       \1/p'

unset NACRE_VALIDATION # which takes time
printf '\nFrames: a ball frame is one lookup a pixel, a direct one evaluates every light in it; the floor reads its inputs alone.\n'
"$nacre" bench --size 1280x720 --lights 1 --lights 4 --lights 16 || failed=1
if [ -n "$(command -v Xvfb)" ] && [ -n "$(command -v xdotool)" ]; then
    scripts/viewer_figures.sh "$nacre" 2>/dev/null || echo "window       cannot be shown by this device under Xvfb"
else
    echo "window       needs Xvfb and xdotool"
fi
[ $failed = 0 ] && echo "passed" || echo "FAILED"
exit $failed
