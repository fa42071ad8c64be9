#!/usr/bin/env bash
# run.sh NACRE FOLDER: has `nacre export --gltf` judged by Khronos's gltf-validator, which FOLDER keeps. Exit code 77: skipped.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
. "$sources/../support/npm_package.sh"
. "$sources/../support/surface_to_export.sh"
npm_package gltf-validator "$sources" "$folder"
cd "$folder"
surface_to_export "$nacre"
"$nacre" export a.nacre --gltf surface.glb --force
"$nacre" export 'ggx:diffuse=0;specular=0.9,0.6,0.4;alpha=0.2' --gltf metal.glb --force
node "$sources/check_glb.mjs" . surface.glb metal.glb
