#include "evaluation/charts/html_page.h"

#include <fmt/format.h>

#include "engine/files/whole_file.h"

namespace nacre {

namespace {

constexpr const char* kStyle = R"(<style>
body { font: 16px/1.5 sans-serif; color: #222; background: #fff; max-width: 60rem; margin: 0 auto; padding: 1rem; overflow-wrap: break-word; }
svg { width: 100%; height: auto; }
img { max-width: 100%; height: auto; }
.wide { overflow-x: auto; }
.chart img { width: 100%; min-width: 44rem; max-width: none; }
svg.narrow { max-width: 34rem; display: block; }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(7rem, 1fr)); gap: 0.6rem; }
.large { grid-template-columns: repeat(auto-fill, minmax(14rem, 1fr)); }
figure { margin: 0; }
figure img { width: 100%; background: #1f1f1f; }
figcaption { font-size: 0.75rem; line-height: 1.3; color: #555; overflow-wrap: anywhere; }
.warning { border-left: 4px solid #d55e00; padding-left: 0.7rem; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.15rem 0.6rem; text-align: left; border-bottom: 1px solid #ddd; }
.wide td { white-space: nowrap; }
tr.front td { color: #0072b2; }
tr.default td { color: #d55e00; font-weight: bold; }
</style>)";

} // namespace

std::string pageHead(const std::string& title, const std::string& heading)
{
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escaped(title) + "</title>\n" + kStyle + "</head><body>\n<h1>" + escaped(heading) + "</h1>\n";
}

std::string tableRow(const std::vector<std::string>& cells, const std::string& kind)
{
    std::string html = fmt::format("<tr class=\"{}\">", kind);
    for (const std::string& cell : cells) {
        html += "<td>" + escaped(cell) + "</td>";
    }
    return html + "</tr>\n";
}

std::string tableOf(const std::vector<std::string>& heads, const std::string& body)
{
    std::string html = "<div class=\"wide\"><table><tr>";
    for (const std::string& head : heads) {
        html += "<th>" + escaped(head) + "</th>";
    }
    return html + "</tr>\n" + body + "</table></div>\n";
}

std::string listOf(const std::vector<std::pair<std::string, std::string>>& entries)
{
    std::string body;
    for (const auto& [name, value] : entries) {
        body += tableRow({name, value});
    }
    return "<table>" + body + "</table>\n";
}

std::string folded(const std::string& summary, const std::string& html)
{
    return "<details><summary>" + escaped(summary) + "</summary>" + html + "</details>\n";
}

std::string dataUri(const std::filesystem::path& file, const std::string& kind)
{
    return "data:image/" + kind + ";base64," + base64(readWholeFile(file, "a picture"));
}

} // namespace nacre
