#!/usr/bin/env bash
# What a measured BRDF shows on another shape, a sphere under nine lights that were not captured: decibels against the truth.
#   scripts/transfer_on_materials.sh NACRE DATA WORK_DIR [FAMILY]
# DATA/found/materials holds captures of measured materials on a bunny and their truth; FAMILY, merl-abc (default) or
# merl-sgd, names the published fits that twenty captures of a bumpy solid are made of. Prints a Markdown
# table: the mean over the lights in dB.
set -euo pipefail
nacre=$1 data=$2 work=$3 family=${4:-merl-abc}
export NACRE_FITS_DIR=$data/measured
. "$(dirname "$0")/materials_of_fits.sh"
mkdir -p "$work"
quietly=(--quiet --force)
mapfile -t lights < <(awk '{ printf "%.6f,%.6f,%.6f\n", $1, $2, $3 }' "$data/found/materials/new_lights.txt")
"$nacre" synth "$work/sphere" --shape sphere --side 128 --lights 4 --give-lights "${quietly[@]}"

number() { sed -n "s/.*\"$1\": \([0-9.eE+-]*\).*/\1/p" "$2" | head -n 1; }

# Prints a row. Truth: TRUTH_0.exr and so on; the acquired radiance is SCALE times the truth's.
row() { # NAME CAPTURE SHAPE MASK TRUTH SCALE
    local sum=0 k=0
    "$nacre" acquire "$2" -o "$work/measured.nacre" --residual none --cast-shadows off "${quietly[@]}" 2>/dev/null
    for light in "${lights[@]}"; do
        local strength
        strength=$(awk "BEGIN { print 1 / $6 }")
        "$nacre" render "$work/measured.nacre" --onto "$3" --light="$light,$strength,$strength,$strength" -o "$work/shown.exr" \
            "${quietly[@]}"
        "$nacre" compare "$work/shown.exr" "$5_$k.exr" --mask "$4" --json "$work/compared.json" --force >/dev/null
        sum=$(awk "BEGIN { print $sum + $(number radiancePsnr "$work/compared.json") }")
        k=$((k + 1))
    done
    printf '| %s | %.1f |\n' "$1" "$(awk "BEGIN { print $sum / $k }")"
}

echo "| material | transferred |"
echo "|---|---|"
{
    for capture in "$data"/found/materials/*/; do
        row "$(basename "$capture")" "$capture" "$data/found/materials/sphere.exr" \
            "$data/found/materials/sphere_mask.png" "${capture}sphere" 1
    done
    for material in $metals $others; do
        capture=$work/$family-$material
        [ -d "$capture" ] ||
            "$nacre" synth "$capture" --material "$family:$material" --side 128 --sphere-size 64 --give-lights --quiet
        for k in "${!lights[@]}"; do
            "$nacre" render --material "$family:$material" --onto "$work/sphere/truth/normals.exr" --light="${lights[$k]}" \
                -o "$work/truth_$k.exr" "${quietly[@]}"
        done
        row "$material" "$capture" "$work/sphere/truth/normals.exr" "$work/sphere/mask.png" "$work/truth" \
            "$(number radianceScale "$capture/truth/brdf.json")"
    done
} | tee "$work/rows"
awk -F'|' -v found="$(ls -d "$data"/found/materials/*/ | wc -l)" '
    { which = NR <= found ? 0 : 1; n[which]++; decibels[which] += $3 }
    END { printf "| mean, measured | %.1f |\n| mean, fits | %.1f |\n", decibels[0] / n[0], decibels[1] / n[1] }' "$work/rows"
