#!/usr/bin/env bash
# parameters_on_fits.sh NACRE FITS KIND: how near glTF's and standard_surface's parameters come to the 100 published fits
# of MERL (KIND merl-abc or merl-sgd; FITS is the folder of their tables): percentiles in dB, how many are warned of and
# refused, and the lines behind them in parameters-KIND.txt.
set -euo pipefail
nacre=$1 fits=$2 kind=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
log=parameters-$kind.txt
: >"$log"
for name in $(tail -n +2 "$fits/${kind/-/_}_params.csv" | cut -d, -f1); do
    "$nacre" export "$kind:$name" --fits "$fits" --force --gltf "$folder/a.glb" --materialx "$folder/a.mtlx" >>"$log" 2>&1 || true
done
echo "$(grep -c warning: "$log" || true) warnings, $(grep -c 'no parameters' "$log" || true) refusals"
for format in glTF standard_surface; do
    grep -o ": $format [0-9.]* dB on" "$log" | cut -d' ' -f3 | sort -g |
        awk -v f=$format '{v[NR]=$1} END {print f ": " NR " materials, 0/5/25/50/75/95/100 %: " v[1], v[int(.05*NR)+1], v[int(.25*NR)+1], v[int(.5*NR)+1], v[int(.75*NR)+1], v[int(.95*NR)], v[NR]}'
done
