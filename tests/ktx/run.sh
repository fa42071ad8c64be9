#!/usr/bin/env bash
# run.sh NACRE FOLDER: has `nacre brdf --export` read by npm's ktx-parse, which FOLDER keeps. Exit code 77: skipped.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
. "$sources/../support/npm_package.sh"
npm_package ktx-parse "$sources" "$folder"
"$nacre" brdf lambert:0.6,0.5,0.4 --quiet --force --export "$folder/lambert.ktx2"
node "$sources/check_ktx2.mjs" "$folder" "$folder/lambert.ktx2"
