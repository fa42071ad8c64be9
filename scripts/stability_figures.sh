#!/bin/sh
# Remakes the tables of docs/limitations.md and its charts: scripts/stability_figures.sh NACRE DILIGENT WORK
# NACRE: the program; DILIGENT: the folder with ballPNG and bearPNG; WORK: a new folder for results, by capture.
set -eu
nacre=$1
diligent=$2
work=$3
charts=$(dirname "$0")/../docs/charts
mkdir "$work"
"$nacre" stress synthetic --side 24 --quiet -o "$work/synthetic"
for object in ball bear; do
  "$nacre" stress "$diligent/${object}PNG" --quiet -o "$work/$object" \
    --methods least-squares,threshold,two-step,ransac,consensus
done
cp "$work/synthetic/direction-normals.svg" "$charts/stress-synthetic-direction.svg"
cp "$work/synthetic/encoded-brdf.svg" "$charts/stress-synthetic-encoded-brdf.svg"
cp "$work/ball/decoded-normals.svg" "$charts/stress-ball-decoded.svg"
