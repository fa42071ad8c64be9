#!/usr/bin/env bash
# What each part of an acquisition costs and brings: seconds against photographs left out, drawn by gnuplot.
#   scripts/parts_front.sh NACRE DATA > docs/charts/parts.csv     writes docs/charts/parts.svg as well
# NACRE: the program. DATA: a folder with DiLiGenT's bearPNG in diligent/, hermes_plaster in rendered/ and bunny_matt in
# found/. On a quiet machine: the least seconds of three runs count.
set -euo pipefail
nacre=$1 data=$2
charts=$(cd "$(dirname "$0")/../docs/charts" && pwd)
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

measure() { # capture's name, parts' name, evaluate's arguments
    local name=$1 parts=$2
    shift 2
    for _ in 1 2 3; do
        "$nacre" evaluate "$@" --json "$work/e.json" --force --quiet 2>/dev/null
        tr -d ' \n' <"$work/e.json" | sed 's/.*"acquisitionSeconds":\([0-9.]*\).*"psnrColour":\([0-9.]*\).*/\1 \2/'
        echo
    done | sort -n | sed '/^$/d' | head -1 | { read -r seconds value && printf '%s,%s,%.2f,%.2f\n' "$name" "$parts" "$seconds" "$value"; }
}

rows() {
    echo "capture,parts,seconds,dB"
    for capture in diligent/bearPNG rendered/hermes_plaster found/bunny_matt; do
        local name=${capture#*/} held=(--hold-out every:4)
        [ "$capture" != diligent/bearPNG ] || held=(--lights-given 82)
        measure "$name" "BRDF" "$data/$capture" "${held[@]}" --self-light off --cast-shadows off --residual none
        measure "$name" "+ self-light" "$data/$capture" "${held[@]}" --cast-shadows off --residual none
        measure "$name" "+ shadows" "$data/$capture" "${held[@]}" --residual none
        measure "$name" "+ layer" "$data/$capture" "${held[@]}"
    done
}

rows | tee "$work/parts.csv"
gnuplot - <<EOF
set terminal svg size 760,480 font "sans,13" background "white"
set output "$charts/parts.svg"
set datafile separator ","
set xlabel "seconds of the acquisition"
set ylabel "colour PSNR of photographs left out, dB"
set key outside right top
set grid
set offsets graph 0.15, graph 0.22, graph 0.08, graph 0.08
plot for [name in "bearPNG hermes_plaster bunny_matt"] \
    "< grep ^".name." $work/parts.csv" using 3:4 with linespoints pt 7 lw 2 title name noenhanced, \
    "< grep '+' $work/parts.csv" using 3:4:2 with labels left offset 0.6,-0.6 font "sans,10" notitle, \
    "< grep BRDF $work/parts.csv" using 3:4:2 with labels right offset -0.4,0.6 font "sans,10" notitle
EOF
