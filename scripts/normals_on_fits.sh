#!/usr/bin/env bash
# Angular errors of every normal method on synthetic captures of twenty published fits (36 lights, cast shadows, noise 0.2 %).
#   scripts/normals_on_fits.sh NACRE FITS_DIR WORK_DIR [FAMILY]
# FAMILY is merl-abc (default) or merl-sgd: which fits the captures are made of. Prints a Markdown table of mean degrees.
# Exemplars use the built-in reflectances ("exemplar"), and those with the published fits ("with fits"), the object's own
# name, its numbered siblings and its prefixes left out.
set -euo pipefail
nacre=$1 fits=$2 work=$3 family=${4:-merl-abc}
. "$(dirname "$0")/materials_of_fits.sh"
mkdir -p "$work"

# Names that are prefixes of the material, or have it as theirs, share its base word.
twins() {
    cut -d, -f1 "$fits/merl_abc_params.csv" "$fits/merl_sgd_params.csv" | sort -u | while read -r name; do
        case $1 in "$name"*) echo "$name" ;; esac
        case $name in "$1"*) echo "$name" ;; esac
    done | sort -u | paste -sd,
}

meanError() { # capture, normals' options
    local capture=$1
    shift
    "$nacre" normals "$capture" -o "$work/normals.exr" --json "$work/summary.json" --force --quiet "$@"
    sed -n 's/.*"meanErrorDegrees": \([0-9.eE+-]*\).*/\1/p' "$work/summary.json"
}

columns=(least-squares ransac consensus exemplar "with fits" auto)
echo "| material | ${columns[0]} | ${columns[1]} | ${columns[2]} | ${columns[3]} | ${columns[4]} | ${columns[5]} |"
echo "|---|---|---|---|---|---|---|"
rows="$work/rows"
: >"$rows"
for material in $metals $others; do
    capture="$work/$family-$material"
    [ -d "$capture" ] || "$nacre" synth "$capture" --material "$family:$material" --fits "$fits" --side 128 --sphere-size 64 --give-lights --quiet
    row="$material"
    for method in least-squares ransac consensus exemplar; do
        row="$row $(meanError "$capture" --normals $method)"
    done
    row="$row $(meanError "$capture" --normals exemplar --fits "$fits" --exclude-reflectance "$(twins "$material")")"
    row="$row $(meanError "$capture" --normals auto)"
    echo "$row" | tee -a "$rows" | awk '{printf "| %s", $1; for (i = 2; i <= NF; ++i) printf " | %.2f", $i; print " |"}'
done
awk '{for (i = 2; i <= NF; ++i) {all[i] += $i; if (NR <= 6) metal[i] += $i}; n = NF}
     END {printf "| **mean of the six metals**"; for (i = 2; i <= n; ++i) printf " | %.2f", metal[i] / 6; print " |"
          printf "| **mean of all**"; for (i = 2; i <= n; ++i) printf " | %.2f", all[i] / NR; print " |"}' "$rows"
