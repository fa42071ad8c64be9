#!/usr/bin/env bash
# page_figures.sh NACRE CAPTURE BYTES EVERY [ARGUMENTS]: what a page of at most BYTES (0: any) shows in Chromium. Every
# so many-th photograph is held out of the surface, and predicted by the page and by nacre render: PSNR in dB. Then the
# time to the first picture and the frames a second while a light is dragged at 1280x800, then with eight lights on a
# sphere of 1024x1024 pixels, by balls and without.
# ARGUMENTS: of acquire and calibrate, such as --mirror-sphere.
set -euo pipefail
nacre=$1 capture=$2 bytes=$3 every=$4
shift 4
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
"$nacre" calibrate "$capture" "$@" -o "$work/lights.json" --quiet
mapfile -t photographs < <(sed -n 's/.*"photograph": "\(.*\)".*/\1/p' "$work/lights.json")
held=()
for ((i = every - 1; i < ${#photographs[@]}; i += every)); do held+=("$i"); done
"$nacre" acquire "$capture" "$@" -o "$work/s.nacre" --quiet $(for i in "${held[@]}"; do echo --skip "${photographs[i]}"; done)
size=$("$nacre" info "$work/s.nacre" | sed -n '1s/.* \([0-9]*x[0-9]*\),.*/\1/p')
"$nacre" export "$work/s.nacre" --page "$work/page.html" $([ "$bytes" = 0 ] || echo --budget-bytes "$bytes")

# Tells what the page shows under lights that it did not see, as pictures of the capture's size.
cat >"$work/harness.html" <<END
<!DOCTYPE html><iframe id="hold"></iframe><script>
const hold = document.getElementById("hold").contentDocument; // the document is dumped once all has loaded
hold.open();
hold.write("<p>");
const lights = $(cat "$work/lights.json").lights, held = [$(IFS=,; echo "${held[*]}")];
const say = text => document.body.append(Object.assign(document.createElement("p"), { textContent: text }));
const started = performance.now();
document.write('<iframe id="page" src="page.html" width="1280" height="800"></iframe>');
async function measure() {
    const frame = document.getElementById("page");
    await new Promise(loaded => frame.addEventListener("load", loaded));
    const inside = frame.contentWindow, page = await inside.nacrePage;
    const shown = () => new Promise(done => inside.requestAnimationFrame(done));
    await shown();
    page.codes();
    say(\`first \${((performance.now() - started) / 1000).toFixed(2)} end\`);
    for (const i of held) {
        const { direction, irradiance, distance } = lights[i];
        page.go(\`#light=\${[...direction, ...irradiance, ...(distance ? [distance] : [])]}&exposure=0\`);
        const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
        [canvas.width, canvas.height] = "$size".split("x").map(Number);
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.putImageData(page.codes(), page.shape.x, page.shape.y);
        say(\`picture \${i} \${canvas.toDataURL("image/png").split(",")[1]} end\`);
    }
    const rate = async hash => {
        page.go(hash);
        let frames = 0;
        const begun = performance.now();
        for (; performance.now() - begun < 6000; ++frames) {
            page.drag(frames % 200 < 100 ? 2 : -2, frames % 160 < 80 ? 1 : -1);
            await shown();
        }
        return (1000 * frames / (performance.now() - begun)).toFixed(1);
    };
    say(\`frames \${await rate("#")} end\`);
    page.scene.shapes.push(inside.eval("sphereShape(1024)"));
    page.scene.stops.push(page.scene.stops.at(-1));
    const eight = Array.from({ length: 8 }, (_, i) => [Math.cos(i), Math.sin(i), 0.3 + 0.2 * i]);
    const many = \`#shape=\${page.scene.shapes.length - 1}&light=\${eight.join(";")}\`;
    say(\`balls \${await rate(many)} end\`);
    page.painter.ballsPay = () => false;
    say(\`tables \${await rate(many)} end\`);
}
measure().catch(error => say(\`error \${error.stack} end\`)).finally(() => hold.close());
</script>
END
timeout 120 chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --no-first-run --user-data-dir="$work/profile" --allow-file-access-from-files \
    --host-resolver-rules='MAP * ~NOTFOUND' --dump-dom "file://$work/harness.html" >"$work/said" 2>/dev/null
said() { sed -n "s/.*<p>$1 \([^<]*\) end.*/\1/p" "$work/said"; }
[ -z "$(said error)" ] || { said error >&2; exit 1; }

"$nacre" export "$work/s.nacre" --write-normals "$work/normals.png" --quiet
oiiotool "$work/normals.png" --chsum --mulc 100 --clamp:max=1 -d uint8 -o "$work/mask.png"
psnr() { "$nacre" compare "$1" "$capture/$2" --mask "$work/mask.png" | sed -n 's/^PSNR *\([0-9.]*\).*/\1/p'; }
for i in "${held[@]}"; do
    said "picture $i" | base64 -d >"$work/shown.png"
    oiiotool "$work/shown.png" --ch R,G,B --colorconvert sRGB linear -d float -o "$work/shown.exr"
    "$nacre" render "$work/s.nacre" --rig "$work/lights.json#$((i + 1))" -o "$work/rendered.exr" --force >/dev/null 2>&1
    name=${photographs[i]}
    echo "$name: rendered $(psnr "$work/rendered.exr" "$name") dB, page $(psnr "$work/shown.exr" "$name") dB"
done | tee "$work/figures"
awk '{ r += $3; p += $6 } END { printf "mean of %d held out: rendered %.2f dB, page %.2f dB\n", NR, r / NR, p / NR }' "$work/figures"
echo "first picture after $(said first) s, $(said frames) frames a second; eight lights on a sphere $(said balls), $(said tables) without balls"
