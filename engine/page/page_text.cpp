#include "engine/page/page_text.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <sstream>

#include "page_files.h"

namespace nacre {
namespace {

std::string_view embedded(const std::string& name)
{
    const auto* const found = std::find_if(std::begin(kEmbeddedTexts), std::end(kEmbeddedTexts),
                                           [&](const auto& file) { return file.first == name; });
    assert(found != std::end(kEmbeddedTexts));
    return found->second;
}

std::string pathOf(const std::string& name)
{
    return (name.starts_with("shared/") ? "shaders/" : "engine/page/") + name;
}

void appendShader(const std::string& name, std::set<std::string>& taken, std::string& text)
{
    if (!taken.insert(name).second) {
        return;
    }
    std::istringstream lines{std::string(embedded(name))};
    for (std::string line; std::getline(lines, line);) {
        const size_t quote = line.find('"');
        if (!line.starts_with("#include") || quote == std::string::npos) {
            text += line + "\n";
            continue;
        }
        const std::string included = line.substr(quote + 1, line.rfind('"') - quote - 1);
        appendShader(pathOf(included.starts_with("shared/") ? included : "shared/" + included), taken, text);
    }
}

std::string pieceOf(const std::string& name, const PagePieces& pieces)
{
    if (name == "title") {
        return pieces.title;
    }
    if (name == "description") {
        return pieces.description;
    }
    if (name == "parts") {
        return pieces.parts;
    }
    return name.ends_with(".frag") || name.ends_with(".vert") ? pageShader(name) : std::string(embedded(pathOf(name)));
}

} // namespace

std::string pageShader(const std::string& name)
{
    std::string text;
    std::set<std::string> taken;
    appendShader(pathOf(name), taken, text);
    return text;
}

std::string filledPage(const PagePieces& pieces)
{
    const std::string_view frame = embedded("engine/page/page.html");
    std::string html;
    size_t at = 0;
    for (size_t mark = frame.find("{{"); mark != frame.npos; mark = frame.find("{{", at)) {
        const size_t end = frame.find("}}", mark);
        html += frame.substr(at, mark - at);
        html += pieceOf(std::string(frame.substr(mark + 2, end - mark - 2)), pieces);
        at = end + 2;
    }
    return html.append(frame.substr(at));
}

} // namespace nacre
