#!/bin/sh
# Measures the tables of docs/limitations.md and draws its chart: scripts/stability_figures.sh NACRE DILIGENT WORK
# NACRE: the program; DILIGENT: the folder with ballPNG, bearPNG and readingPNG; WORK: a new folder for results, by capture.
set -eu
nacre=$1
diligent=$2
work=$3
charts=$(dirname "$0")/../docs/charts
mkdir "$work"
"$nacre" stress synthetic --side 24 --quiet -o "$work/synthetic"
for object in ball bear reading; do
  "$nacre" stress "$diligent/${object}PNG" --quiet -o "$work/$object"
done
cp "$work/synthetic/direction-normals.svg" "$charts/stress-synthetic-direction.svg"
