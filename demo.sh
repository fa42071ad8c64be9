#!/usr/bin/env bash
# On a fresh Debian 12: installs what the program needs, builds, and makes the demo's contact sheet.
set -euo pipefail
cd "$(dirname "$0")"
program_only=1
. scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target nacre
build/release/app/nacre demo --force "$@"
