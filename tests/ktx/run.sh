#!/usr/bin/env bash
# run.sh NACRE FOLDER: has `nacre brdf --export` read by npm's ktx-parse, installed into FOLDER once from the lock file.
# Exit code 77, skipped: no node and npm here, or no registry.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "needs node and npm (Debian packages nodejs, npm)"
    exit 77
fi
mkdir -p "$folder"
cp "$sources/package.json" "$sources/package-lock.json" "$folder"
if ! [ -d "$folder/node_modules/ktx-parse" ] &&
    ! npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts --fetch-retries 0 >"$folder/npm.log" 2>&1; then
    echo "needs the npm registry for ktx-parse:"
    tail -n 3 "$folder/npm.log"
    exit 77
fi
"$nacre" brdf lambert:0.6,0.5,0.4 --quiet --force --export "$folder/lambert.ktx2"
node "$sources/check_ktx2.mjs" "$folder" "$folder/lambert.ktx2"
