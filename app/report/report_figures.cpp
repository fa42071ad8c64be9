#include "app/report/report_figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "evaluation/charts/html_page.h"

namespace nacre {

namespace {

// Told apart by people who do not see red and green as two: Okabe, Ito, Color Universal Design, 2008.
constexpr const char* kGivenColour = "#0072b2";
constexpr const char* kJudgingColour = "#d55e00";
constexpr double kFigureWidth = 360; // pixels

std::string svgHead(double height)
{
    return fmt::format("<svg class=\"narrow\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" "
                       "width=\"{0}\" height=\"{1:.0f}\" "
                       "font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\">\n",
                       kFigureWidth, height);
}

// `anchor`: start, middle or end; `more`: further attributes, each with a space before it.
std::string textMark(double x, double y, const char* anchor, const std::string& content, const std::string& more = "")
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(content));
}

std::string lineMark(double x0, double y0, double x1, double y1, const char* colour)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x0, y0, x1,
                       y1, colour);
}

// Nearly, in pixels.
double labelWidth(const std::string& text)
{
    constexpr double kLetter = 6.4;
    return kLetter * static_cast<double>(text.size()) + 2;
}

constexpr double kNames = 104, kTexts = 62; // pixels
constexpr double kRow = 17, kBar = 11, kSecondRow = 8, kSecondBar = 5, kLegendRow = 18;
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
        const double left = kFigureWidth - kTexts - x;
        const double width =
            std::clamp(part.length / full * (kFigureWidth - kTexts - kNames), 0.0, std::max(0.0, left));
        svg += rectangle(x, y, width, height, part.colour);
        x += width;
    }
    return svg + (bar.text.empty() ? "" : textMark(kFigureWidth - kTexts + 6, middle + 3.5, "start", bar.text));
}

// Below the bars; answers the end of it.
double addLegend(const std::vector<BarLegend>& legend, double y, std::string& svg)
{
    double x = 6;
    for (const BarLegend& entry : legend) {
        const double width = labelWidth(entry.meaning) + 22;
        if (x + width > kFigureWidth && x > 6) {
            x = 6;
            y += kLegendRow;
        }
        svg += rectangle(x, y, 11, 11, entry.colour) + textMark(x + 15, y + 9.5, "start", entry.meaning);
        x += width;
    }
    return y + kLegendRow;
}

constexpr double kCentre = 170, kRim = 150;

std::string circle(double x, double y, double radius, const std::string& style, const std::string& title)
{
    const std::string inner = title.empty() ? "" : "<title>" + escaped(title) + "</title>";
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}>{}</circle>\n", x, y, radius, style, inner);
}

// The share of texels along the third coordinate that were measured.
double coveredShare(const BrdfTable& table, int i, int j)
{
    int covered = 0;
    for (int k = 0; k < table.size.z; ++k) {
        covered += table.confidence[table.index(i, j, k)] >= 1;
    }
    return static_cast<double>(covered) / table.size.z;
}

// White to blue.
std::string shade(double share)
{
    const glm::dvec3 colour = glm::mix(glm::dvec3(240), glm::dvec3(0, 114, 178), share);
    return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(colour.x), static_cast<int>(colour.y),
                       static_cast<int>(colour.z));
}

// Where a texel's centre stands, in degrees of its coordinate.
double degreesOf(const BrdfTable& table, int axis, double unit)
{
    const bool natural = table.domain.coordinates == kNatural;
    return natural ? 90 * unit : axis == 0 ? 90 * unit * unit : glm::degrees(table.domain.thetaDMax) * unit;
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
    return svgHead(height) + body + "</svg>\n";
}

std::string lightFigure(const std::vector<ReviewedPhotograph>& photographs)
{
    std::string svg = svgHead(2 * kCentre + 6);
    for (const int polar : {30, 60, 90}) {
        const double radius = kRim * polar / 90;
        svg += circle(kCentre, kCentre, radius, "fill=\"none\" stroke=\"#ccc\"", "") +
               textMark(kCentre + 3, kCentre + radius - 3, "start", fmt::format("{}", polar), " fill=\"#777\"");
    }
    svg += lineMark(kCentre - kRim, kCentre, kCentre + kRim, kCentre, "#e6e6e6") +
           lineMark(kCentre, kCentre - kRim, kCentre, kCentre + kRim, "#e6e6e6");
    for (const ReviewedPhotograph& photograph : photographs) {
        const glm::vec3& d = photograph.light.direction;
        const double sine = std::hypot(d.x, d.y), polar = glm::degrees(std::atan2(sine, static_cast<double>(d.z)));
        const double scale = sine > 0 ? kRim * polar / 90 / sine : 0;
        const bool judges = photograph.heldOutPsnr || !photograph.isGiven;
        svg += circle(kCentre + scale * d.x, kCentre - scale * d.y, 4,
                      fmt::format("fill=\"{}\" fill-opacity=\"0.85\"", judges ? kJudgingColour : kGivenColour),
                      fmt::format("{}: {:.1f} degrees off the view", photograph.name, polar));
    }
    return svg + "</svg>\n";
}

std::string coverageFigure(const BrdfTable& table)
{
    constexpr double kLeft = 44, kTop = 6, kRight = 8, kBottom = 40;
    const bool natural = table.domain.coordinates == kNatural;
    const double height = 200, across = kFigureWidth - kLeft - kRight, down = height - kTop - kBottom;
    const double cellWidth = across / table.size.x, cellHeight = down / table.size.y;
    std::string svg = svgHead(height);
    for (int j = 0; j < table.size.y; ++j) {
        for (int i = 0; i < table.size.x;) {
            // Equal neighbours are one rectangle.
            const std::string colour = shade(coveredShare(table, i, j));
            const int first = i;
            while (i < table.size.x && shade(coveredShare(table, i, j)) == colour) {
                ++i;
            }
            svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                               kLeft + first * cellWidth, kTop + j * cellHeight, (i - first) * cellWidth + 0.1,
                               cellHeight + 0.1, colour);
        }
    }
    for (const double unit : {0.0, 0.5, 1.0}) {
        svg += textMark(kLeft + unit * across, height - kBottom + 14, unit > 0.9 ? "end" : "middle",
                        fmt::format("{:.1f}", degreesOf(table, 0, unit))) +
               textMark(kLeft - 5, kTop + unit * down + (unit > 0.9 ? 0 : 8), "end",
                        fmt::format("{:.1f}", degreesOf(table, 1, unit)));
    }
    return svg +
           textMark(kLeft + across / 2, height - 8, "middle",
                    natural ? "thetaI, degrees" : "thetaH, degrees (0: the highlight's middle)") +
           textMark(0, 0, "middle", natural ? "thetaO, degrees" : "thetaD, degrees",
                    fmt::format(" transform=\"translate(11 {:.1f}) rotate(-90)\"", kTop + down / 2)) +
           "</svg>\n";
}

} // namespace nacre
