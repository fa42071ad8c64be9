#!/usr/bin/env bash
# Says where the real captures and measured materials are to be had, how they have to lie for the tests, and which are
# there. Downloads nothing: their terms are their owners'.
#   scripts/data_sets.sh [FOLDER]     FOLDER: what NACRE_DATA_DIR names (default: ../shared/data)
set -euo pipefail
cd "$(dirname "$0")/.."
data=${1:-../shared/data}

data_set() { # NAME, A FILE OF IT IN FOLDER (or nothing), URL, LAYOUT
    echo "$1"
    echo "  from    $3"
    echo "  layout  $4"
    [ -z "$2" ] && return
    if [ -e "$data/$2" ]; then echo "  found   $data/$2"; else echo "  missing $data/$2"; fi
}

data_set "University of Washington, photometric stereo (psmImages.zip)" psm/horse/horse.mask.tga \
    "https://courses.cs.washington.edu/courses/cse455/10wi/projects/project4/ (TGA)" \
    "psm/NAME/NAME.0.tga to NAME.11.tga and NAME.mask.tga; NAME: horse, buddha, cat, chrome, gray"
data_set "DiLiGenT, photometric stereo benchmark" diligent/ballPNG/Normal_gt.mat \
    "https://sites.google.com/site/photometricstereodata/single (DiLiGenT.zip, its folder pmsData)" \
    "diligent/ballPNG and diligent/bearPNG as they come: 001.png to 096.png, filenames.txt, light_*.txt, mask.png, Normal_gt.*"
data_set "MERL, 100 isotropic materials; for nacre brdf and render, no test needs them" "" \
    "https://www.merl.com/research/downloads/BRDF/" "NAME.binary, in any folder"
data_set "RGL, measured materials; for nacre brdf and render" "" \
    "https://rgl.epfl.ch/materials" "NAME_rgb.bsdf, in any folder"
echo
echo "Tests find them with: cmake --preset release -DNACRE_DATA_DIR=FOLDER. The test run lists those that were skipped."
