#include "evaluation/charts/light_figure.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "evaluation/charts/chart_marks.h"

namespace nacre {

namespace {

constexpr double kLightFigureWidth = 360; // pixels
constexpr double kCentre = 170, kRim = 150;

std::string svgHead(double width, double height)
{
    return fmt::format("<svg class=\"narrow\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
                       "width=\"{0}\" height=\"{1}\" "
                       "font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\">\n",
                       width, height);
}

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

// White to the blue of fronts.
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

std::string lightFigure(const std::vector<ReviewedPhotograph>& photographs)
{
    std::string svg = svgHead(kLightFigureWidth, 2 * kCentre + 6);
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
                      fmt::format("fill=\"{}\" fill-opacity=\"0.85\"", judges ? kDefaultColour : kFrontColour),
                      fmt::format("{}: {:.1f} degrees off the view", photograph.name, polar));
    }
    return svg + "</svg>\n";
}

std::string coverageFigure(const BrdfTable& table)
{
    constexpr double kLeft = 44, kTop = 6, kRight = 8, kBottom = 40;
    const bool natural = table.domain.coordinates == kNatural;
    const double height = 200, across = kLightFigureWidth - kLeft - kRight, down = height - kTop - kBottom;
    const double cellWidth = across / table.size.x, cellHeight = down / table.size.y;
    std::string svg = svgHead(kLightFigureWidth, height);
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
