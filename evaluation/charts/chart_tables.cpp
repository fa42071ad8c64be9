#include "evaluation/charts/chart_tables.h"

#include <fmt/format.h>

namespace nacre {

std::string csvField(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return quoted + "\"";
}

std::string csvOf(const std::vector<NormalRow>& rows)
{
    std::string text = "capture,method,lights_given,seconds,mean_degrees,median_degrees,percentile95_degrees,"
                       "missing_pixels,held_out_psnr_decibels,is_default,refusal\n";
    for (const NormalRow& r : rows) {
        const bool done = r.refusal.empty();
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csvField(r.capture), nameOf(r.setting.method),
                            r.photographs, done ? fmt::format("{:.4f}", r.seconds) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.mean) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.median) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.percentile95) : "",
                            done && r.hasTruth ? std::to_string(r.error.missing) : "",
                            done && !r.hasTruth ? fmt::format("{:.4f}", r.psnr) : "",
                            isDefault(r.setting) ? "yes" : "no", csvField(r.refusal));
    }
    return text;
}

std::string csvOf(const std::vector<BrdfRow>& rows)
{
    std::string text = "capture,interpolation,k,texels_x,texels_y,texels_z,format,bytes,bake_seconds,"
                       "held_out_psnr_decibels,is_default\n";
    for (const BrdfRow& r : rows) {
        text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f},{}\n", csvField(r.capture),
                            nameOf(r.setting.interpolation), r.setting.k, r.size.x, r.size.y, r.size.z,
                            nameOf(r.setting.format), r.bytes, r.seconds, r.psnr, isDefault(r.setting) ? "yes" : "no");
    }
    return text;
}

std::string csvOf(const std::vector<RenderingRow>& rows)
{
    std::string text = "capture,path,ball_texels,ball_texels_shown,lights,steady_frame_ms,moved_lights_frame_ms,"
                       "picture_psnr_decibels,is_default\n";
    for (const RenderingRow& row : rows) {
        text += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{}\n", csvField(row.capture),
                            row.setting.isBall ? "ball" : "direct", row.setting.size.radiance, row.setting.size.display,
                            row.lights, row.steadyMs, row.movedMs, row.psnr, row.isDefault ? "yes" : "no");
    }
    return text;
}

} // namespace nacre
