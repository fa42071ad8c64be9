#include "evaluation/charts/bar_figure.h"

#include <algorithm>

#include <fmt/format.h>

#include "evaluation/charts/chart_labels.h"
#include "evaluation/charts/chart_marks.h"

namespace nacre {

namespace {

constexpr double kBarsWidth = 360, kNames = 104, kTexts = 62; // pixels
constexpr double kRow = 17, kBar = 11, kSecondRow = 8, kSecondBar = 5, kBarsLegendRow = 18;
constexpr size_t kLongestName = 15; // letters

// The end of a name tells photographs apart.
std::string shortened(const std::string& name)
{
    return name.size() <= kLongestName ? name : ".." + name.substr(name.size() - kLongestName + 2);
}

std::string rectangle(double x, double y, double width, double height, const char* colour)
{
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
                       width, height, colour);
}

std::string barOf(const Bar& bar, double y, double full)
{
    const bool isFirst = !bar.name.empty();
    const double height = isFirst ? kBar : kSecondBar, middle = y + height / 2;
    std::string svg = isFirst ? textMark(kNames - 6, middle + 3.5, "end", shortened(bar.name)) : "";
    double x = kNames;
    for (const BarPart& part : bar.parts) {
        const double left = kBarsWidth - kTexts - x;
        const double width = std::clamp(part.length / full * (kBarsWidth - kTexts - kNames), 0.0, std::max(0.0, left));
        svg += rectangle(x, y, width, height, part.colour);
        x += width;
    }
    return svg + (bar.text.empty() ? "" : textMark(kBarsWidth - kTexts + 6, middle + 3.5, "start", bar.text));
}

// Below the bars; answers the end of it.
double addLegend(const std::vector<BarLegend>& legend, double y, std::string& svg)
{
    double x = 6;
    for (const BarLegend& entry : legend) {
        const double width = labelWidth(entry.meaning) + 22;
        if (x + width > kBarsWidth && x > 6) {
            x = 6;
            y += kBarsLegendRow;
        }
        svg += rectangle(x, y, 11, 11, entry.colour) + textMark(x + 15, y + 9.5, "start", entry.meaning);
        x += width;
    }
    return y + kBarsLegendRow;
}

} // namespace

std::string barFigure(const std::vector<Bar>& bars, double full, const std::vector<BarLegend>& legend)
{
    std::string body;
    double y = 4;
    for (size_t i = 0; i < bars.size(); ++i) {
        body += barOf(bars[i], y, full);
        const bool isFollowed = i + 1 < bars.size() && bars[i + 1].name.empty();
        y += isFollowed ? kBar + 1 : bars[i].name.empty() ? kSecondRow : kRow;
    }
    const double height = addLegend(legend, y + 6, body);
    return fmt::format(
               "<svg class=\"narrow\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
               "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\">\n",
               kBarsWidth, height) +
           body + "</svg>\n";
}

} // namespace nacre
