#!/usr/bin/env bash
# run.sh NACRE FOLDER: has `nacre export --gltf` judged by Khronos's gltf-validator, installed into FOLDER once from the
# lock file. Exit code 77, skipped: no node and npm here, or no registry.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "needs node and npm (Debian packages nodejs, npm)"
    exit 77
fi
mkdir -p "$folder"
cp "$sources/package.json" "$sources/package-lock.json" "$folder"
if ! [ -d "$folder/node_modules/gltf-validator" ] &&
    ! npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts --fetch-retries 0 --fetch-timeout 20000 >"$folder/npm.log" 2>&1; then
    echo "needs the npm registry for gltf-validator:"
    tail -n 3 "$folder/npm.log"
    exit 77
fi
cd "$folder"
rm -rf capture a.nacre
"$nacre" synth capture --shape bumpy --side 48 --lights 12 --noise 0 --give-lights --material 'ggx:diffuse=0.5,0.3,0.2;alpha=0.3' >/dev/null
"$nacre" acquire capture --normals least-squares --quiet -o a.nacre
"$nacre" export a.nacre --gltf surface.glb --force
"$nacre" export 'ggx:diffuse=0;specular=0.9,0.6,0.4;alpha=0.2' --gltf metal.glb --force
node "$sources/check_glb.mjs" . surface.glb metal.glb
