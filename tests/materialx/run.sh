#!/usr/bin/env bash
# run.sh NACRE FOLDER: has `nacre export --materialx` judged by the MaterialX library, which FOLDER keeps as an npm package
# has it. Exit code 77: skipped.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
. "$sources/../support/npm_package.sh"
. "$sources/../support/surface_to_export.sh"
npm_package @needle-tools/materialx "$sources" "$folder"
cd "$folder"
surface_to_export "$nacre"
"$nacre" export a.nacre --materialx surface.mtlx --force
"$nacre" export 'ggx:diffuse=0;specular=0.9,0.6,0.4;alpha=0.2' --materialx metal.mtlx --force
"$nacre" export 'ggx:diffuse=0.1;specular=0.5;alpha=0.9' --materialx sheen.mtlx --force

# That the judge sees what is wrong: an input of another type or name, a node that nobody knows, a shader that is missing.
wrongs=('s/name="base" type="float"/name="base" type="color3"/' 's/"specular_roughness"/"roughness"/'
    's/standard_surface\b/standard_face/' 's/nodename="/nodename="no_/')
for i in "${!wrongs[@]}"; do sed "${wrongs[i]}" surface.mtlx >"wrong-$i.mtlx"; done
node "$sources/check_mtlx.mjs" . surface.mtlx metal.mtlx sheen.mtlx --wrong wrong-*.mtlx
