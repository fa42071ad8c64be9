#!/usr/bin/env bash
# run_browser.sh NACRE FOLDER: opens the pages that nacre writes in a browser without a screen, as wide as a telephone
# and as a desk show them. Exit code 77, skipped: chromium is missing.
set -euo pipefail
nacre=$1
command -v chromium >/dev/null || { echo "needs chromium (apt.txt)"; exit 77; }
rm -rf "$2"
mkdir -p "$2"
work=$(cd "$2" && pwd)

# In frames, since a window is never narrower than 500 pixels. Once all is loaded, a line a frame says what it holds.
tell='<script>addEventListener("load", () => {
    for (const frame of document.querySelectorAll("iframe")) {
        const page = frame.contentDocument, wide = page.documentElement.scrollWidth;
        const said = document.createElement("p");
        said.textContent = `page ${frame.name} width ${frame.contentWindow.innerWidth} ` +
            `wider ${wide > frame.contentWindow.innerWidth} pictures ${page.images.length} ` +
            `broken ${[...page.images].filter(i => i.naturalWidth === 0).length} ` +
            `figures ${page.querySelectorAll("svg").length} ` +
            `links ${page.querySelectorAll("[href], script[src], iframe").length} end`;
        document.body.append(said);
    }
});</script>'

# Answers the lines, and leaves the console's in $work/console.
open_pages() { # NAME:WIDTH:FILE...
    { echo "<!DOCTYPE html><body>$tell"
      for page in "$@"; do
          IFS=: read -r name width file <<<"$page"
          echo "<iframe name='$name' width='$width' height='800' style='border: 0' src='file://$work/$file'></iframe>"
      done; } >"$work/frames.html"
    timeout 60 chromium --headless=new --no-sandbox --disable-gpu --no-first-run --user-data-dir="$work/profile" \
        --allow-file-access-from-files --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --dump-dom \
        "file://$work/frames.html" 2>"$work/browser.log" | grep -o 'page [a-z]* width.*end' || true
    grep CONSOLE "$work/browser.log" >"$work/console" || true
}

failures=0
check() { # NAME COMMAND...
    local name=$1
    shift
    if "$@"; then echo "ok    $name"; else echo "FAIL  $name"; failures=$((failures + 1)); fi
}
says() { grep -Eq -- "$1" <<<"$said"; }
console_is_silent() { [ ! -s "$work/console" ]; }
not() { ! "$@"; }

"$nacre" synth "$work/capture" --quiet --shape sphere --side 48 --sphere-size 48 --lights 14 --give-lights
"$nacre" acquire "$work/capture" -o "$work/s.nacre" --normals consensus --tolerance 40dB --report "$work/acquired" --quiet
"$nacre" chart "$work/capture" -o "$work/charts" --methods least-squares,consensus --lights-given all --k 25 --quiet \
    --parts normals,brdf

said=$(open_pages telephone:390:acquired/report.html desk:1280:acquired/report.html charts:390:charts/report.html)
echo "$said"
# 14 photographs, normals, confidence and a ball; lights, verdicts, predictions and coverage.
whole='wider false pictures 17 broken 0 figures 4 links 0 end'
check "acquire's report on a telephone" says "page telephone width 390 $whole"
check "acquire's report on a desk" says "page desk width 1280 $whole"
check "chart's report on a telephone" says 'page charts width 390 wider false pictures 3 broken 0 figures 0 links 0 end'
check "nothing on the console" console_is_silent
cat "$work/console"

# What the checks above see of pages that are no good.
echo '<!DOCTYPE html><body><img src="data:image/png;base64,AAAA"><div style="width: 500px">wide</div>' >"$work/broken.html"
echo '<!DOCTYPE html><body><script>console.error("trouble")</script>' >"$work/loud.html"
said=$(open_pages broken:390:broken.html loud:390:loud.html)
check "a broken picture and a page too wide are seen" says 'page broken width 390 wider true pictures 1 broken 1 '
check "a message on the console is seen" not console_is_silent
exit $((failures > 0))
