#!/usr/bin/env bash
# On a fresh Debian 12: installs what apt.txt lists, builds, and runs every test.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release
ctest --preset release -j "$(nproc)" "$@"
