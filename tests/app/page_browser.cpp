#include "tests/app/page_browser.h"

#include <cstdint>

#include <fmt/format.h>

#include "engine/files/whole_file.h"
#include "tests/app/page_gestures.h"

namespace nacre::test {
namespace {

std::string decoded64(const std::string& text)
{
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    uint32_t group = 0, bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        group = group << 6 | static_cast<uint32_t>(letters.find(c));
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(group >> bits & 0xFF);
        }
    }
    return bytes;
}

} // namespace

// The document's load, after which it is dumped, waits for a frame whose writing goes on.
std::string harness(const std::vector<PageFrame>& frames)
{
    std::string elements, hashes;
    for (const PageFrame& frame : frames) {
        elements += fmt::format("<iframe class=\"page\" name=\"{}\" src=\"{}\" width=\"{}\" height=\"844\"></iframe>\n",
                                frame.name, frame.file, frame.width);
        hashes += fmt::format("\"{}\": [", frame.name);
        for (const PageState& state : frame.states) {
            hashes += fmt::format("\"{}&zoom=1\",", state.hash);
        }
        hashes += "],\n";
    }
    return R"(<!DOCTYPE html><meta charset="utf-8"><body><iframe id="hold"></iframe>
)" + elements +
           R"(<script>
const hold = document.getElementById("hold").contentDocument;
hold.open();
hold.write("<p>");
const hashes = {)" +
           hashes + R"(};
const say = text => document.body.append(Object.assign(document.createElement("p"), { textContent: text }));
)" + kGestures +
           R"(async function show(frame) {
    if (!frame.contentWindow.nacrePage) {
        await new Promise(loaded => frame.addEventListener("load", loaded));
    }
    const page = await frame.contentWindow.nacrePage;
    if (/^far/.test(frame.name)) {
        page.painter.ballsPay = () => true; // small as they are
    }
    const tell = (hash, i) => {
        page.go(hash);
        const cut = document.createElement("canvas");
        cut.width = page.shape.width;
        cut.height = page.shape.height;
        cut.getContext("2d").drawImage(page.canvas, -page.frame.x, -page.frame.y);
        say(`picture ${frame.name}-${i} ${cut.toDataURL("image/png").split(",")[1]} end`);
    };
    hashes[frame.name].forEach(tell);
    const context = page.painter.gl.getExtension("WEBGL_lose_context");
    const event = kind => new Promise(come => page.canvas.addEventListener(kind, come, { once: true }));
    const lost = event("webglcontextlost"), back = event("webglcontextrestored");
    context.loseContext();
    await lost;
    setTimeout(() => context.restoreContext()); // after the event
    await back;
    tell(hashes[frame.name][0], "again");
    say(`balls ${frame.name} ${[...page.painter.onDevice.keys()].filter(key => /^ball \d/.test(key)).length} end`);
    say(`gestures ${frame.name} ${gestures(frame.contentWindow, page)} end`);
    const root = frame.contentDocument.documentElement;
    say(`wider ${frame.name} ${root.scrollWidth > frame.contentWindow.innerWidth} end`);
}
Promise.all([...document.querySelectorAll(".page")].map(show))
    .catch(error => say(`error ${error.stack} end`)).finally(() => hold.close());
</script>)";
}

std::string saidBehind(const std::string& document, const std::string& mark)
{
    const size_t at = document.find(">" + mark);
    const size_t end = document.find(" end<", at);
    return at == document.npos || end == document.npos
               ? ""
               : document.substr(at + 1 + mark.size(), end - at - 1 - mark.size());
}

ProgramRun browse(const TempFolder& folder, const std::string& file)
{
    return runProgram("/usr/bin/timeout",
                      {"60", "chromium", "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                       "--enable-unsafe-swiftshader", "--no-first-run", "--allow-file-access-from-files",
                       "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", "--dump-dom",
                       "--user-data-dir=" + (folder / "profile").string(), "file://" + (folder / file).string()});
}

bool hasBrowser()
{
    return runProgram("/bin/sh", {"-c", "command -v chromium"}).exitCode == 0;
}

Image shownPicture(const std::string& document, const std::string& name, const TempFolder& folder)
{
    writeText(folder / "shown.png", decoded64(saidBehind(document, "picture " + name + " ")));
    return loadImage(folder / "shown.png");
}

} // namespace nacre::test
