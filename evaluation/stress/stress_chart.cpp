#include "evaluation/stress/stress_chart.h"

#include <algorithm>

#include <fmt/format.h>

#include "evaluation/charts/chart_axis.h"
#include "evaluation/charts/chart_labels.h"
#include "evaluation/charts/chart_marks.h"
#include "evaluation/stress/stress_tables.h"

namespace nacre {

namespace {

constexpr double kWidth = 720, kHeight = 400; // pixels
constexpr double kLeft = 62, kRight = 18, kTop = 40, kBottom = 52;
constexpr double kLegendRow = 20;
// As chart_marks.h, without the reds.
constexpr const char* kColours[] = {"#0072b2", "#e69f00", "#009e73", "#56b4e9", "#cc79a7", "#000000", "#8c8c1e"};
constexpr const char* kSilentColour = "#d00000";

struct Plot {
    std::vector<std::string> settings, methods;
    ChartScale scale;

    double x(const std::string& setting) const
    {
        const auto at = std::find(settings.begin(), settings.end(), setting) - settings.begin();
        return kLeft +
               (static_cast<double>(at) + 0.5) / static_cast<double>(settings.size()) * (kWidth - kLeft - kRight);
    }
    double y(double error) const { return kHeight - kBottom - scale.position(error) * (kHeight - kTop - kBottom); }
};

bool isDrawn(const StressRow& row)
{
    return row.said != Said::refusal && isPlottable(row.error, true);
}

const char* colourOf(size_t series)
{
    return kColours[series % std::size(kColours)];
}

std::string cross(double x, double y)
{
    return fmt::format("<path d=\"M{:.1f} {:.1f}l14 14m0 -14l-14 14\" stroke=\"{}\" stroke-width=\"2.5\" "
                       "fill=\"none\"/>\n",
                       x - 7, y - 7, kSilentColour);
}

std::string whiteCentre(double x, double y)
{
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"#fff\"/>\n", x, y);
}

std::string axesOf(const Plot& plot, const StressRow& any)
{
    const double bottom = kHeight - kBottom, right = kWidth - kRight;
    std::string svg;
    for (const double tick : plot.scale.ticks()) {
        svg += lineMark(kLeft, plot.y(tick), right, plot.y(tick), "#e6e6e6") +
               textMark(kLeft - 7, plot.y(tick) + 4, "end", tickText(tick));
    }
    for (const std::string& setting : plot.settings) {
        svg += textMark(plot.x(setting), bottom + 17, "middle", setting);
    }
    return svg + lineMark(kLeft, bottom, right, bottom, "#444") + lineMark(kLeft, kTop, kLeft, bottom, "#444") +
           textMark((kLeft + right) / 2, bottom + 38, "middle", any.unit) +
           textMark(0, 0, "middle", any.isBrdf ? "error, % of the radiance" : "mean error, degrees",
                    fmt::format(" transform=\"translate(16 {:.1f}) rotate(-90)\"", (kTop + bottom) / 2));
}

std::string curveOf(const Plot& plot, const std::vector<StressRow>& curve, size_t series)
{
    std::string path, marks;
    const std::optional<size_t> broken = breakingPoint(curve);
    for (size_t i = 0; i < curve.size(); ++i) {
        const StressRow& row = curve[i];
        if (!isDrawn(row)) {
            continue;
        }
        const double x = plot.x(row.setting), y = plot.y(row.error);
        path += fmt::format("{:.1f},{:.1f} ", x, y);
        marks += seriesMark(x, y, series, isSilentFailure(row) ? kSilentColour : colourOf(series));
        marks += row.said == Said::warning ? whiteCentre(x, y) : "";
        marks += isSilentFailure(row) ? cross(x, y) : "";
        marks += broken == i ? ringMark(x, y) : "";
    }
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
                       "stroke-opacity=\"0.7\"/>\n",
                       path, colourOf(series)) +
           marks;
}

// Rows of entries below the axes; answers their height.
double addLegend(const std::vector<std::string>& methods, std::string& svg)
{
    double x = kLeft, y = kHeight + 8;
    const auto add = [&](const std::string& sign, const std::string& name) {
        const double width = labelWidth(name) + 28;
        if (x + width > kWidth && x > kLeft) {
            x = kLeft;
            y += kLegendRow;
        }
        svg += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">{}{}</g>\n", x, y, sign,
                           textMark(14, 4, "start", name));
        x += width;
    };
    for (size_t i = 0; i < methods.size(); ++i) {
        add(seriesMark(0, 0, i, colourOf(i)), methods[i]);
    }
    add(seriesMark(0, 0, 0, "#555") + whiteCentre(0, 0), "the program warned");
    add(ringMark(0, 0), "breaks here");
    add(cross(0, 0), "silent failure");
    return y + kLegendRow - kHeight;
}

} // namespace

std::string stressSvg(const std::vector<StressRow>& rows)
{
    std::vector<double> errors;
    for (const StressRow& row : rows) {
        if (isDrawn(row)) {
            errors.push_back(row.error);
        }
    }
    if (errors.empty()) {
        return {};
    }
    const Plot plot{distinctOf(rows, &StressRow::setting), distinctOf(rows, &StressRow::method),
                    ChartScale(errors, true)};
    std::string body = axesOf(plot, rows.front());
    for (size_t i = 0; i < plot.methods.size(); ++i) {
        body += curveOf(plot, rowsWhere(rows, &StressRow::method, plot.methods[i]), i);
    }
    const double height = kHeight + addLegend(plot.methods, body);
    const std::string title =
        fmt::format("{}: {}, {}", rows.front().capture, rows.front().sweep, rows.front().isBrdf ? "BRDF" : "normals");
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                       "font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\" stroke=\"none\">\n"
                       "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
                       kWidth, height) +
           textMark(kLeft, 24, "start", title, " font-size=\"15\" font-weight=\"bold\"") + body + "</svg>\n";
}

std::vector<StressChart> stressChartsOf(const std::vector<StressRow>& rows)
{
    std::vector<StressChart> charts;
    for (const std::string& sweep : distinctOf(rows, &StressRow::sweep)) {
        for (const bool isBrdf : {false, true}) {
            std::vector<StressRow> own = rowsWhere(rows, &StressRow::sweep, sweep);
            std::erase_if(own, [&](const StressRow& row) { return row.isBrdf != isBrdf; });
            std::string svg = stressSvg(own);
            if (!svg.empty()) {
                charts.push_back({fmt::format("{}-{}.svg", sweep, isBrdf ? "brdf" : "normals"), std::move(svg)});
            }
        }
    }
    return charts;
}

} // namespace nacre
