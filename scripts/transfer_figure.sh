#!/usr/bin/env bash
# docs/transfer.png: a material photographed on one shape (a synthetic capture) worn by a cloth and a head, under two
# lightings, beside reference balls.
#   scripts/transfer_figure.sh NACRE WORK_DIR [PICTURE]
set -euo pipefail
nacre=$1 work=$2 picture=${3:-docs/transfer.png}
mkdir -p "$work"
capture="$work/plastic-capture" plastic="$work/red-plastic.nacre"
# Lights nearly to the side, so that the rim of three-point asks for nothing that was not measured.
"$nacre" synth "$capture" --material "ggx:diffuse=0.42,0.05,0.04;specular=0.05;alpha=0.18" --lights 64 --cap-degrees 84 --side 256 \
    --quiet --force
"$nacre" acquire "$capture" -o "$plastic" --quiet --force
"$nacre" transfer --materials "$plastic" --onto make:cloth:twill,make:head --rig key,three-point --size 250x250 -o "$work/transfer" --force
cp "$work/transfer/sheet.png" "$picture"
