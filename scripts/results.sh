#!/usr/bin/env bash
# Measures the rows behind the tables of docs/results.md and prints them as CSV: scripts/results.sh NACRE DATA > docs/results.csv
# NACRE: the program. DATA: a folder with DiLiGenT's ballPNG, bearPNG and readingPNG in diligent/, the University of
# Washington's set in psm/, and PSBox in psbox/.
# Frames, whose times depend on the machine, are measured by `nacre bench`.
set -euo pipefail
nacre=$1 data=$2
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
spheres=(--mirror-sphere "$data/psm/chrome" --diffuse-sphere "$data/psm/gray")

# Mean degrees between the normals and the true ones.
normals() { # capture's name, photographs given or all, normals' arguments
    local name=$1 given=$2
    shift 2
    [ "$given" = all ] || set -- "$@" --lights-given "$given"
    for method in least-squares threshold two-step ransac consensus exemplar auto; do
        "$nacre" normals "$@" --normals $method -o "$work/n.exr" --json "$work/n.json" --force --quiet 2>/dev/null
        printf '%s,%.2f,degrees\n' "normals,$name,$given,$method" \
            "$(sed -n 's/.*"meanErrorDegrees": \([0-9.]*\).*/\1/p' "$work/n.json")"
    done
}

# Colour PSNR of radiance over all photographs held out, of Nacre and of its rivals.
relighting() { # capture's name, photographs given, evaluate's arguments
    local name=$1 given=$2
    shift 2
    "$nacre" evaluate "$@" --baselines --json "$work/e.json" --force --quiet 2>/dev/null
    tr -d ' \n' <"$work/e.json" | sed 's/.*"methods":\[//' | grep -o '"method":"[^"]*","psnrColour":[0-9.]*' |
        sed 's/"method":"\([^"]*\)","psnrColour":\(.*\)/\1 \2/' |
        while read -r method value; do
            printf '%s,%.2f,dB\n' "relighting,$name,$given,$method" "$value"
        done
}

echo "table,capture,lights,method,value,unit"
for object in ball bear reading; do
    for given in all 36 12; do
        normals $object $given "$data/diligent/${object}PNG"
    done
done
normals gray all "$data/psm/gray" "${spheres[@]}" --truth sphere
for object in ball bear; do
    for given in 82 36 12; do
        relighting $object $given "$data/diligent/${object}PNG" --lights-given $given
    done
done
for object in cat horse buddha; do
    relighting $object 11 "$data/psm/$object" "${spheres[@]}" --hold-out each
done

# PSBox has no capture's layout of its own: twelve photographs and their lights.
psbox=$(cd "$data/psbox/data" && pwd)
mkdir "$work/psbox"
printf '{"format": "nacre capture", "version": 1, "transfer": "linear", "lights": "%s/light_directions.txt", "photographs": [%s]}\n' \
    "$psbox" "$(printf '"%s"\n' "$psbox"/Objects/Image_*.png | paste -sd,)" >"$work/psbox/capture.json"
relighting psbox 11 "$work/psbox" --hold-out each
