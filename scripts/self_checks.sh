#!/usr/bin/env bash
# The figures of every self-check over all captures: scripts/self_checks.sh NACRE DATA > docs/self_checks.csv
# NACRE: the program; DATA: the captures' folder. Figures as "nacre normals --json" lists them; an asterisk: a warning.
set -euo pipefail
nacre=$1 data=$2
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

row() { # NAME, arguments of nacre normals
    local name=$1
    shift
    "$nacre" normals "$@" -o "$work/n.exr" --json "$work/n.json" --force --quiet 2>"$work/error" || {
        echo "$name,\"$(head -1 "$work/error")\""
        return
    }
    python3 - "$name" "$work/n.json" <<'P'
import json, sys
codes = ["transfer-curve-left", "transfer-curve-taken", "offset-left", "lights-near", "directions-contradicted", "lights-turned",
         "axes-mixed", "mask-dark", "mask-inverted", "mask-elsewhere", "camera-shake", "photographs-alike", "normals-unstable", "clipped", "shadowed", "unexplained"]
degrees = {"directions-contradicted", "lights-turned", "normals-unstable"}
document = json.load(open(sys.argv[2]))
checks, found = document["checks"], {f["code"]: f for f in document["findings"] if f["warning"] or f["code"] == "intensities-corrected"}
def cell(code):
    if code not in checks:
        return "" if code not in found else "*"
    value = checks[code]["value"]
    text = f"{value:.1f}" if code in degrees else f"{value:.2f}"
    return text + ("*" if code in found else "")
others = " ".join(sorted(code for code in found if code not in codes))
print(",".join([sys.argv[1], *map(cell, codes), others]))
P
}

echo "capture,transfer-curve-left,transfer-curve-taken,offset-left,lights-near,directions-contradicted,lights-turned,axes-mixed,mask-dark,mask-inverted,mask-elsewhere,camera-shake,photographs-alike,normals-unstable,clipped,shadowed,unexplained,other warnings"
for name in buddha cat horse; do
    row "$name" "$data/psm/$name" --mirror-sphere "$data/psm/chrome" --diffuse-sphere "$data/psm/gray" --offset auto
done
row "grey ball" "$data/psm/gray" --mirror-sphere "$data/psm/chrome"
for name in ball bear reading; do
    row "$name" "$data/diligent/${name}PNG"
done
for name in hermes_plaster bowl_white suzanne_metal suzanne_two_painted; do
    row "$name" "$data/rendered/$name"
done
near=$data/rendered/suzanne_near
row suzanne_near "$near/suzanne" --mirror-sphere "$near/chrome" --diffuse-sphere "$near/gray"
for name in nike choonsik bunny_matt; do
    row "$name" "$data/found/$name"
done
row ball_srgb "$data/found/ball_srgb" --rig "$data/found/ball_srgb/LightMatrix.yml" --skip normal
for name in cc_amber_citrine colodur_azure_4e satin_gold spectralon; do
    row "$name" "$data/found/materials/${name}_rgb"
done
row psbox "$data/psbox/data/Objects" --rig "$data/psbox/data/light_directions.txt"
