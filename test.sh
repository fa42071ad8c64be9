#!/usr/bin/env bash
# On a fresh Debian 12: installs what apt.txt lists, builds, runs every test, and lists those that were skipped.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release
ctest --preset release -j "$(nproc)" "$@"
skipped=$(sed -n 's/^\[  SKIPPED \] \([^ ]*\)$/  \1/p' build/release/Testing/Temporary/LastTest.log | sort -u)
[ -z "$skipped" ] || printf 'Skipped (scripts/data_sets.sh says where captures are to be had):\n%s\n' "$skipped"
