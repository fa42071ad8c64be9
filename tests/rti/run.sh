#!/usr/bin/env bash
# run.sh NACRE FOLDER: what `nacre export` writes, shown by a decoder that is not ours and compared with `nacre render`.
# Exit code 77, skipped: no node or oiiotool here.
set -euo pipefail
nacre=$1 folder=$2
sources=$(cd "$(dirname "$0")" && pwd)
for tool in node oiiotool; do
    if ! command -v $tool >/dev/null; then
        echo "needs $tool (Debian packages nodejs, openimageio-tools)"
        exit 77
    fi
done
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
# Six and nine smooth terms cannot follow a highlight, nor the edge of attached shadow: a matt material leaves 26.5 to 28.5
# dB. Rows, axes, channels, scales, biases or terms (the second ones by the two lights' places) that are taken otherwise
# leave at most 24.2.
"$nacre" synth capture --shape bumpy --side 64 --lights 8 --sphere-size 96 --noise 0 --no-shadows --give-lights --material lambert:0.7,0.5,0.3 >/dev/null
"$nacre" acquire capture --normals least-squares --quiet -o a.nacre
"$nacre" export a.nacre --ptm a.ptm --rti-web web --exposure 0 --lights 64
"$nacre" export a.nacre --write-normals mask.png --quiet
oiiotool mask.png -d uint8 -o mask.ppm
"$nacre" render a.nacre --light=0.85,0.1,0.5172 --exposure 0 -o one.png --quiet
"$nacre" render a.nacre --light=0.6,0.6,0.5292 --exposure 0 -o two.png --quiet
pictures=(one.png --ch R,G,B -o one.ppm two.png --ch R,G,B -o two.ppm)
for plane in web/plane_*.jpg; do
    pictures+=("$plane" -o "${plane%.jpg}.ppm")
done
oiiotool "${pictures[@]}"
node "$sources/check_rti.mjs" one.ppm mask.ppm 0.85 0.1 a.ptm web 25.5
node "$sources/check_rti.mjs" two.ppm mask.ppm 0.6 0.6 a.ptm web 25.5
