#!/usr/bin/env bash
# How high a highlight stands on another shape: the brightest of a sphere under three lights that were not captured, over
# the truth, for GGX of falling gloss, acquired from a bumpy solid with its own normals (0.2 % noise).
#   scripts/highlight_peaks.sh NACRE WORK_DIR [EXPOSURES]
# EXPOSURES: relative times of each photograph's bracket (default 1,0.25,0.0625: nothing is clipped). Needs oiiotool. Prints a Markdown table: alpha, and a ratio of red, green and blue for each light.
set -euo pipefail
nacre=$1 work=$2 exposures=${3:-1,0.25,0.0625}
mkdir -p "$work"
quietly=(--quiet --force)
"$nacre" synth "$work/sphere" --shape sphere --side 256 --lights 4 --give-lights "${quietly[@]}"
brightest() { oiiotool --stats "$1" | awk '/Stats Max/ { print $3, $4, $5; exit }'; }
echo "| alpha | light 1 | light 2 | light 3 |"
echo "|---|---|---|---|"
for alpha in 0.05 0.07 0.1 0.2 0.3; do
    material="ggx:diffuse=0.3,0.2,0.1;specular=0.05;alpha=$alpha"
    "$nacre" synth "$work/capture" --shape bumpy --side 192 --lights 36 --exposures "$exposures" --noise 0.002 --give-lights \
        --material "$material" "${quietly[@]}"
    "$nacre" acquire "$work/capture" -o "$work/measured.nacre" --residual none --cast-shadows off "${quietly[@]}" 2>/dev/null
    scale=$(sed -n 's/.*"radianceScale": \([0-9.eE+-]*\).*/\1/p' "$work/capture/truth/brdf.json")
    row="| $alpha |"
    for light in 0.1,0.3,0.95 0.5,-0.2,0.84 -0.4,0.55,0.73; do
        onto=(--onto "$work/sphere/truth/normals.exr" "${quietly[@]}")
        "$nacre" render --material "$material" "${onto[@]}" --light="$light" -o "$work/truth.exr"
        "$nacre" render "$work/measured.nacre" "${onto[@]}" --light="$light" -o "$work/shown.exr"
        row+=$(paste -d' ' <(brightest "$work/shown.exr") <(brightest "$work/truth.exr") |
            awk -v s="$scale" '{ printf " %.2f %.2f %.2f |", $1 / $4 / s, $2 / $5 / s, $3 / $6 / s }')
    done
    echo "$row"
done
