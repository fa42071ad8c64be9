#include "evaluation/charts/chart_marks.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

namespace nacre {

namespace {

std::string polygon(double x, double y, const std::vector<std::pair<double, double>>& corners, const std::string& fill)
{
    std::string points;
    for (const auto& [dx, dy] : corners) {
        points += fmt::format("{:.1f},{:.1f} ", x + dx, y + dy);
    }
    return fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, fill);
}

} // namespace

std::string seriesMark(double x, double y, size_t series, const std::string& fill)
{
    switch (series % 7) {
    case 0:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>\n", x, y, fill);
    case 1:
        return polygon(x, y, {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, fill);
    case 2:
        return polygon(x, y, {{0, -5.5}, {5, 4}, {-5, 4}}, fill);
    case 3:
        return polygon(x, y, {{0, -5.5}, {5.5, 0}, {0, 5.5}, {-5.5, 0}}, fill);
    case 4:
        return polygon(x, y, {{0, 5.5}, {5, -4}, {-5, -4}}, fill);
    case 5:
        return polygon(x, y,
                       {{-1.7, -5},
                        {1.7, -5},
                        {1.7, -1.7},
                        {5, -1.7},
                        {5, 1.7},
                        {1.7, 1.7},
                        {1.7, 5},
                        {-1.7, 5},
                        {-1.7, 1.7},
                        {-5, 1.7},
                        {-5, -1.7},
                        {-1.7, -1.7}},
                       fill);
    default:
        return polygon(x, y, {{0, -5.5}, {5.2, -1.7}, {3.2, 4.4}, {-3.2, 4.4}, {-5.2, -1.7}}, fill);
    }
}

std::string ringMark(double x, double y)
{
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                       x, y, kDefaultColour);
}

std::string textMark(double x, double y, const char* anchor, const std::string& content, const std::string& more)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(content));
}

std::string lineMark(double x0, double y0, double x1, double y1, const char* colour)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x0, y0, x1,
                       y1, colour);
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            // Control characters stand in no XML, however they are written.
            result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return result;
}

} // namespace nacre
