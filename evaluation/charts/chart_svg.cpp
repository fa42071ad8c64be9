#include "evaluation/charts/chart_svg.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "evaluation/charts/chart_labels.h"
#include "evaluation/charts/chart_marks.h"
#include "evaluation/charts/pareto_front.h"

namespace nacre {

namespace {

constexpr double kWidth = 860, kHeight = 520; // pixels
constexpr double kLeft = 66, kRight = 18, kTop = 40, kBottom = 52;
constexpr double kLegendRow = 20;
struct Drawn {
    const ChartPoint* point;
    double x, y; // pixels
    bool isFront;
    size_t series;
};

std::vector<std::string> seriesOf(const Chart& chart)
{
    std::vector<std::string> names;
    for (const ChartPoint& point : chart.points) {
        if (std::find(names.begin(), names.end(), point.series) == names.end()) {
            names.push_back(point.series);
        }
    }
    return names;
}

bool isDrawn(const Chart& chart, const ChartPoint& point)
{
    return isPlottable(point.x, chart.x.isLog) && isPlottable(point.y, chart.y.isLog);
}

double pixelX(const ChartScale& scale, double value)
{
    return kLeft + scale.position(value) * (kWidth - kLeft - kRight);
}

double pixelY(const ChartScale& scale, double value)
{
    return kHeight - kBottom - scale.position(value) * (kHeight - kTop - kBottom);
}

std::string axesOf(const Chart& chart, const ChartScale& x, const ChartScale& y)
{
    const double bottom = kHeight - kBottom, right = kWidth - kRight;
    std::string svg;
    for (const double tick : x.ticks()) {
        svg += lineMark(pixelX(x, tick), kTop, pixelX(x, tick), bottom, "#e6e6e6") +
               textMark(pixelX(x, tick), bottom + 17, "middle", tickText(tick));
    }
    for (const double tick : y.ticks()) {
        svg += lineMark(kLeft, pixelY(y, tick), right, pixelY(y, tick), "#e6e6e6") +
               textMark(kLeft - 7, pixelY(y, tick) + 4, "end", tickText(tick));
    }
    const double middle = (kTop + bottom) / 2;
    const auto better = [](const ChartAxis& axis, const char* less, const char* more) {
        return axis.label + (axis.isLessBetter ? less : more);
    };
    return svg + lineMark(kLeft, bottom, right, bottom, "#444") + lineMark(kLeft, kTop, kLeft, bottom, "#444") +
           textMark((kLeft + right) / 2, bottom + 38, "middle",
                    better(chart.x, " (left is better)", " (right is better)")) +
           textMark(0, 0, "middle", better(chart.y, " (down is better)", " (up is better)"),
                    fmt::format(" transform=\"translate(16 {:.1f}) rotate(-90)\"", middle));
}

// Those of one contest from left to right.
std::vector<std::vector<const Drawn*>> frontLines(const Chart& chart, const std::vector<Drawn>& drawn)
{
    std::vector<std::vector<const Drawn*>> lines;
    for (const std::vector<size_t>& contest : contestsOf(chart)) {
        std::vector<const Drawn*>& line = lines.emplace_back();
        for (const Drawn& d : drawn) {
            const size_t point = static_cast<size_t>(d.point - chart.points.data());
            if (d.isFront && std::binary_search(contest.begin(), contest.end(), point)) {
                line.push_back(&d);
            }
        }
        std::sort(line.begin(), line.end(),
                  [](const Drawn* a, const Drawn* b) { return std::pair(a->x, a->y) < std::pair(b->x, b->y); });
    }
    return lines;
}

// Grey first, so that what matters lies on top.
std::string pointsOf(const Chart& chart, const std::vector<Drawn>& drawn)
{
    std::string below, above, lines;
    for (const Drawn& d : drawn) {
        (d.isFront ? above : below) += seriesMark(d.x, d.y, d.series, d.isFront ? kFrontColour : kDominatedColour);
        above += d.point->isDefault ? ringMark(d.x, d.y) : "";
    }
    for (const std::vector<const Drawn*>& front : frontLines(chart, drawn)) {
        std::string path;
        for (const Drawn* d : front) {
            path += fmt::format("{:.1f},{:.1f} ", d->x, d->y);
        }
        lines += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.5\"/>\n", path,
                             kFrontColour);
    }
    return below + lines + above;
}

void addLine(const std::vector<const Drawn*>& front, std::vector<LabelBox>& boxes)
{
    for (size_t i = 1; i < front.size(); ++i) {
        const Drawn &a = *front[i - 1], &b = *front[i];
        constexpr double kStep = 4;
        const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / kStep) + 1;
        for (int j = 0; j <= steps; ++j) {
            const double t = static_cast<double>(j) / steps;
            boxes.push_back({a.x + t * (b.x - a.x) - 1, a.y + t * (b.y - a.y) - 1, 2, 2});
        }
    }
}

// What labels keep clear of: marks, and the fronts' lines.
std::vector<LabelBox> obstaclesOf(const Chart& chart, const std::vector<Drawn>& drawn)
{
    std::vector<LabelBox> boxes;
    for (const Drawn& d : drawn) {
        const double half = d.point->isDefault ? 10 : 6;
        boxes.push_back({d.x - half, d.y - half, 2 * half, 2 * half});
    }
    for (const std::vector<const Drawn*>& front : frontLines(chart, drawn)) {
        addLine(front, boxes);
    }
    return boxes;
}

std::string labelsOf(const Chart& chart, const std::vector<Drawn>& drawn)
{
    std::vector<LabelAnchor> anchors;
    for (const Drawn& d : drawn) {
        if (d.isFront || d.point->isDefault) {
            anchors.push_back({d.x, d.y, d.point->label});
        }
    }
    std::string lines, texts;
    const LabelBox frame{kLeft + 2, kTop, kWidth - kLeft - kRight - 4, kHeight - kTop - kBottom - 2};
    for (const PlacedLabel& label : placeLabels(anchors, obstaclesOf(chart, drawn), frame)) {
        const LabelBox& box = label.box;
        const double x = std::clamp(label.anchor.x, box.x, box.x + box.width),
                     y = std::clamp(label.anchor.y, box.y, box.y + box.height);
        constexpr double kFar = 13; // beyond it, a line tells to which point a label belongs
        if (std::hypot(x - label.anchor.x, y - label.anchor.y) > kFar) {
            lines += lineMark(label.anchor.x, label.anchor.y, x, y, "#999");
        }
        // Lines to other labels pass behind.
        texts += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fff\" "
                             "fill-opacity=\"0.85\"/>\n",
                             box.x, box.y, box.width, box.height) +
                 textMark(box.x + box.width / 2, box.y + kLabelHeight - 3, "middle", label.anchor.text);
    }
    return lines + texts;
}

// Rows of entries below the axes; answers their height.
double addLegend(const std::vector<std::string>& series, std::string& svg)
{
    double x = kLeft, y = kHeight + 8;
    const auto entry = [&](const std::string& sign, const std::string& name, double width) {
        svg += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">{}{}</g>\n", x, y, sign,
                           textMark(14, 4, "start", name));
        x += width;
    };
    const auto add = [&](const std::string& sign, const std::string& name) {
        const double width = labelWidth(name) + 28;
        if (x + width > kWidth && x > kLeft) {
            x = kLeft;
            y += kLegendRow;
        }
        entry(sign, name, width);
    };
    for (size_t i = 0; i < series.size(); ++i) {
        add(seriesMark(0, 0, i, "#555"), series[i]);
    }
    add(seriesMark(0, 0, 0, kFrontColour), "blue: no other setting beats it");
    add(seriesMark(0, 0, 0, kDominatedColour), "grey: dominated");
    add(ringMark(0, 0), "the program's default");
    return y + kLegendRow - kHeight;
}

std::vector<Drawn> drawnOf(const Chart& chart, const std::vector<std::string>& series, const ChartScale& x,
                           const ChartScale& y)
{
    const std::vector<char> front = frontOf(chart);
    std::vector<Drawn> drawn;
    for (size_t i = 0; i < chart.points.size(); ++i) {
        const ChartPoint& point = chart.points[i];
        if (isDrawn(chart, point)) {
            const auto at = std::find(series.begin(), series.end(), point.series) - series.begin();
            drawn.push_back({&point, pixelX(x, point.x), pixelY(y, point.y), front[i] != 0, static_cast<size_t>(at)});
        }
    }
    return drawn;
}

std::string bodyOf(const Chart& chart, double& legendHeight)
{
    std::vector<double> xs, ys;
    for (const ChartPoint& point : chart.points) {
        if (isDrawn(chart, point)) {
            xs.push_back(point.x);
            ys.push_back(point.y);
        }
    }
    if (xs.empty()) {
        return textMark(kWidth / 2, kHeight / 2, "middle", "nothing was measured");
    }
    const ChartScale x(xs, chart.x.isLog), y(ys, chart.y.isLog);
    const std::vector<std::string> series = seriesOf(chart);
    const std::vector<Drawn> drawn = drawnOf(chart, series, x, y);
    std::string legend;
    legendHeight = addLegend(series, legend);
    return axesOf(chart, x, y) + pointsOf(chart, drawn) + labelsOf(chart, drawn) + legend;
}

} // namespace

std::vector<std::vector<size_t>> contestsOf(const Chart& chart)
{
    const std::vector<std::string> series = seriesOf(chart);
    std::vector<std::vector<size_t>> contests(chart.isFrontPerSeries ? series.size() : 1);
    for (size_t i = 0; i < chart.points.size(); ++i) {
        const auto at = std::find(series.begin(), series.end(), chart.points[i].series) - series.begin();
        contests[chart.isFrontPerSeries ? static_cast<size_t>(at) : 0].push_back(i);
    }
    return contests;
}

std::vector<char> frontOf(const Chart& chart)
{
    std::vector<char> front(chart.points.size(), 0);
    for (const std::vector<size_t>& contest : contestsOf(chart)) {
        std::vector<Cost> costs;
        for (const size_t i : contest) {
            const ChartPoint& point = chart.points[i];
            const double unknown = std::nan("");
            costs.push_back({chart.x.isLessBetter ? point.x : -point.x, chart.y.isLessBetter ? point.y : -point.y});
            costs.back() = isDrawn(chart, point) ? costs.back() : Cost{unknown, unknown};
        }
        const std::vector<char> own = paretoFront(costs);
        for (size_t i = 0; i < contest.size(); ++i) {
            front[contest[i]] = own[i];
        }
    }
    return front;
}

std::string svgOf(const Chart& chart)
{
    double legendHeight = 0;
    const std::string body = bodyOf(chart, legendHeight);
    const double height = kHeight + legendHeight;
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                       "font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\" stroke=\"none\">\n"
                       "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
                       kWidth, height) +
           textMark(kLeft, 24, "start", chart.title, " font-size=\"15\" font-weight=\"bold\"") + body + "</svg>\n";
}

} // namespace nacre
