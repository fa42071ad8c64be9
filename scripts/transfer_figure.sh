#!/usr/bin/env bash
# docs/transfer.png: a material photographed on one shape (a synthetic capture) worn by a cloth and a head, under two
# lightings, beside reference balls.
#   scripts/transfer_figure.sh NACRE WORK_DIR [PICTURE]
set -euo pipefail
nacre=$1 work=$2 picture=${3:-docs/transfer.png}
mkdir -p "$work"
synth() { # name, material
    "$nacre" synth "$work/$1" --material "$2" --size 256 --quiet --force
    "$nacre" acquire "$work/$1" -o "$work/$1.nacre" --range front --quiet --force
}
synth red-plastic "ggx:diffuse=0.42,0.05,0.04;specular=0.05;alpha=0.18"
synth bronze "ggx:diffuse=0.05,0.03,0.01;specular=0.7,0.45,0.2;alpha=0.3"
"$nacre" transfer --materials "$work/red-plastic.nacre,$work/bronze.nacre" --onto make:cloth,make:head --rig key,three-point \
    --size 300x300 -o "$work/transfer" --force
cp "$work/transfer/sheet.png" "$picture"
