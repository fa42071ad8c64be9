#!/usr/bin/env bash
# Draws the pictures of tests/golden and prints by how much they differ from those that are kept. With --write they take
# their place: look at each of them first (the folder is printed).
#   scripts/bless_goldens.sh [--build DIR] [--write] [NAME...]
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release
write=
names=
while [ $# -gt 0 ]; do
    case $1 in
    --build) build=$2 && shift ;;
    --write) write=1 ;;
    -*) echo "$1 is not known; scripts/bless_goldens.sh [--build DIR] [--write] [NAME...]" >&2 && exit 2 ;;
    *) names=$names:Kept/Golden.IsDrawn/$1 ;;
    esac
    shift
done
tests=$build/tests/nacre_system_tests
[ -x "$tests" ] || { echo "$tests is missing; build it, or give --build DIR" >&2 && exit 3; }
names=${names#:}
# A run that blesses fails by design, so it is the lines about pictures that tell whether it ran.
filter=${names:-Kept/Golden.IsDrawn/*}
lines=$(env ${write:+NACRE_BLESS=1} "$tests" --gtest_filter="$filter" --gtest_brief=1 2>&1 | grep '^  [a-z_]*: ') || true
[ -n "$lines" ] || { echo "no picture was drawn: $tests --gtest_filter='$filter' says why" >&2 && exit 1; }
echo "$lines"
echo "pictures: $build/tests/golden/*/actual.png"
[ -z "$write" ] || echo "look at tests/golden/*.png, then run the tests"
