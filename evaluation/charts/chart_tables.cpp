#include "evaluation/charts/chart_tables.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace nacre {

namespace {

Chart brdfChart(std::span<const BrdfRow> rows, bool againstBytes)
{
    Chart chart{rows.front().capture + (againstBytes ? ": BRDF, held-out photographs against bytes"
                                                     : ": BRDF, held-out photographs against baking time"),
                againstBytes ? "bytes of the tables" : "seconds from samples to tables",
                "PSNR of held-out photographs, dB",
                false,
                {}};
    for (const BrdfRow& row : rows) {
        const bool shown = againstBytes || row.setting.format == TexelFormat::rgba32f;
        chart.points.push_back({nameOf(row.setting.interpolation), describe(row),
                                againstBytes ? static_cast<double>(row.bytes) : row.seconds,
                                shown ? row.psnr : std::nan(""), isDefault(row.setting)});
    }
    return chart;
}

Chart frameChart(std::span<const RenderingRow> rows, const char* title, double RenderingRow::*milliseconds)
{
    Chart chart{rows.front().capture + title, "milliseconds a frame", "PSNR of the picture, dB", false, {}, true};
    for (const RenderingRow& row : rows) {
        chart.points.push_back({row.lights == 1 ? "1 light" : fmt::format("{} lights", row.lights),
                                describe(row.setting), row.*milliseconds, row.psnr, row.isDefault});
    }
    return chart;
}

// For all rows: whether they are on the front of their capture's chart.
template <class Row> std::vector<char> frontOf(const std::vector<Row>& rows, Chart (*chartOf)(std::span<const Row>))
{
    std::vector<char> front;
    for (const std::span<const Row> part : byCapture(rows)) {
        const std::vector<char> own = frontOf(chartOf(part));
        front.insert(front.end(), own.begin(), own.end());
    }
    return front;
}

const char* yesOrNo(bool yes)
{
    return yes ? "yes" : "no";
}

} // namespace

Chart normalChart(std::span<const NormalRow> rows)
{
    const bool truth = rows.front().hasTruth;
    Chart chart{rows.front().capture + ": normals, error against time",
                "seconds from observations to normals",
                truth ? "mean angular error, degrees" : "PSNR of held-out photographs, dB",
                truth,
                {}};
    for (const NormalRow& row : rows) {
        chart.points.push_back({nameOf(row.setting.method), describe(row), row.seconds,
                                !row.refusal.empty() ? std::nan("")
                                : truth              ? row.error.mean
                                                     : row.psnr,
                                isDefault(row.setting)});
    }
    return chart;
}

Chart bytesChart(std::span<const BrdfRow> rows)
{
    return brdfChart(rows, true);
}

Chart bakingChart(std::span<const BrdfRow> rows)
{
    return brdfChart(rows, false);
}

Chart steadyChart(std::span<const RenderingRow> rows)
{
    return frameChart(rows, ": rendering, a frame under lights that stand", &RenderingRow::steadyMs);
}

Chart movedChart(std::span<const RenderingRow> rows)
{
    return frameChart(rows, ": rendering, the first frame after every light has moved", &RenderingRow::movedMs);
}

std::string csvField(const std::string& text)
{
    std::string field;
    for (const char c : text) {
        field += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
    }
    return field.find_first_of(",\"") == std::string::npos ? field : "\"" + field + "\"";
}

std::string csvOf(const std::vector<NormalRow>& rows)
{
    std::string text = "capture,method,lights_given,seconds,mean_degrees,median_degrees,percentile95_degrees,"
                       "missing_pixels,held_out_psnr_decibels,is_default,on_front,refusal\n";
    const std::vector<char> front = frontOf(rows, normalChart);
    for (size_t i = 0; i < rows.size(); ++i) {
        const NormalRow& r = rows[i];
        const bool done = r.refusal.empty();
        const auto number = [](bool known, double value) { return known ? fmt::format("{:.4f}", value) : ""; };
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csvField(r.capture), nameOf(r.setting.method),
                        r.photographs, number(done, r.seconds), number(done && r.hasTruth, r.error.mean),
                        number(done && r.hasTruth, r.error.median), number(done && r.hasTruth, r.error.percentile95),
                        done && r.hasTruth ? std::to_string(r.error.missing) : "", number(done && !r.hasTruth, r.psnr),
                        yesOrNo(isDefault(r.setting)), yesOrNo(front[i]), csvField(r.refusal));
    }
    return text;
}

std::string csvOf(const std::vector<BrdfRow>& rows)
{
    std::string text = "capture,interpolation,k,texels_x,texels_y,texels_z,format,bytes,bake_seconds,"
                       "held_out_psnr_decibels,is_default,on_bytes_front,on_time_front\n";
    const std::vector<char> bytes = frontOf(rows, bytesChart), time = frontOf(rows, bakingChart);
    for (size_t i = 0; i < rows.size(); ++i) {
        const BrdfRow& r = rows[i];
        text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f},{},{},{}\n", csvField(r.capture),
                            nameOf(r.setting.interpolation), r.setting.k, r.size.x, r.size.y, r.size.z,
                            nameOf(r.setting.format), r.bytes, r.seconds, r.psnr, yesOrNo(isDefault(r.setting)),
                            yesOrNo(bytes[i]), yesOrNo(time[i]));
    }
    return text;
}

std::string csvOf(const std::vector<RenderingRow>& rows)
{
    std::string text = "capture,path,ball_texels,ball_texels_shown,lights,steady_frame_ms,moved_lights_frame_ms,"
                       "picture_psnr_decibels,is_default,on_steady_front,on_moved_front\n";
    const std::vector<char> steady = frontOf(rows, steadyChart), moved = frontOf(rows, movedChart);
    for (size_t i = 0; i < rows.size(); ++i) {
        const RenderingRow& row = rows[i];
        text += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{},{},{}\n", csvField(row.capture),
                            row.setting.isBall ? "ball" : "direct", row.setting.size.radiance, row.setting.size.display,
                            row.lights, row.steadyMs, row.movedMs, row.psnr, yesOrNo(row.isDefault), yesOrNo(steady[i]),
                            yesOrNo(moved[i]));
    }
    return text;
}

} // namespace nacre
