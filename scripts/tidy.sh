#!/usr/bin/env bash
# clang-tidy over the sources that a branch changed; bugs that it finds fail, the rest is told.
#   scripts/tidy.sh [COMMIT | --all]     COMMIT: since when (default: where this branch left main; on main, the last commit)
set -euo pipefail
cd "$(dirname "$0")/.."
most=60 # 6 s of processor time each
since=${1:-$(git merge-base HEAD main 2>/dev/null || true)}
[ "$since" != "$(git rev-parse HEAD)" ] || since=
if [ -z "$since" ]; then
    since=$(git rev-parse --quiet --verify HEAD~1) || { echo "clang-tidy: no earlier commit to compare with" >&2; exit 0; }
fi
if [ "$since" = --all ]; then
    most=100000
    changed=$(git ls-files '*.cpp')
else
    changed=$(git diff --name-only --diff-filter=d "$since" -- '*.cpp' '*.h' | sed 's/\.h$/.cpp/' | sort -u)
fi
sources=$(for source in $changed; do [ ! -f "$source" ] || echo "$source"; done)
[ -n "$sources" ] || exit 0
count=$(wc -l <<<"$sources")
[ "$count" -le "$most" ] || echo "clang-tidy looks at $most of $count sources that changed; scripts/tidy.sh --all looks at every one" >&2
cmake --preset tidy >/dev/null
cmake --build --preset tidy --target nacre_gpu_shaders nacre_target_shaders nacre_scene_texts >/dev/null
shuf --random-source=<(yes) -n "$most" <<<"$sources" |
    xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --checks='-clang-analyzer-*' --warnings-as-errors='bugprone-*' 2>/dev/null
