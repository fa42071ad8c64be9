#!/usr/bin/env bash
# docs/targets.png: every target of our own (assets/README.md), three to a row, in turn in glossy plastic, in metal and
# in matt white. Needs oiiotool (openimageio-tools).
#   scripts/targets_sheet.sh NACRE WORK_DIR [PICTURE]
set -euo pipefail
nacre=$1 work=$2 picture=${3:-docs/targets.png}
side=180
materials=("ggx:diffuse=0.42,0.06,0.04;specular=0.05;alpha=0.15"
    "ggx:diffuse=0.02,0.015,0.01;specular=0.8,0.55,0.25;alpha=0.25" "lambert:0.7")
targets=(head drape:ball letters cloth:plain,threads=16 cloth:twill,threads=20 cloth:satin5,threads=20
    drape knit,loops=12 sphere)
mkdir -p "$work"
cells=()
for i in "${!targets[@]}"; do
    "$nacre" target "make:${targets[i]}" --size ${side}x$side -o "$work/$i.nacre" --force --quiet
    "$nacre" render --material "${materials[(i + i / 3) % 3]}" --onto "$work/$i.nacre" --light=-0.55,0.5,0.7 --light=0.9,0.1,0.3,0.2,0.2,0.25 \
        -o "$work/$i.png" --force --quiet
    cells+=("$work/$i.png")
done
oiiotool "${cells[@]}" --mosaic:pad=4 3x3 -o "$picture"
