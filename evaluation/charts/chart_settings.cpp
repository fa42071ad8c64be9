#include "evaluation/charts/chart_settings.h"

#include <algorithm>

#include <fmt/format.h>

namespace nacre {

std::vector<glm::ivec3> chartTableSizes(const glm::ivec3& usual)
{
    const auto part = [](int texels, int divisor) { return std::max(2, (texels + divisor / 2) / divisor); };
    return {
        usual, {usual.x, part(usual.y, 2), part(usual.z, 2)}, {part(usual.x, 2), part(usual.y, 4), part(usual.z, 4)}};
}

std::vector<NormalSetting> normalSettings(const ChartChoices& choices, size_t photographs)
{
    std::vector<NormalSetting> settings;
    for (const size_t given : choices.lightsGiven) {
        for (const NormalMethod method : choices.methods) {
            if (given < photographs) {
                settings.push_back({method, given});
            }
        }
    }
    return settings;
}

std::vector<BrdfSetting> brdfSettings(const ChartChoices& choices)
{
    std::vector<BrdfSetting> settings;
    for (size_t size = 0; size < chartTableSizes(glm::ivec3(8)).size(); ++size) {
        for (const InterpolationMethod interpolation : choices.interpolations) {
            for (const int k : choices.neighbours) {
                for (const TexelFormat format : choices.formats) {
                    settings.push_back({interpolation, k, size, format});
                }
            }
        }
    }
    return settings;
}

bool isDefault(const NormalSetting& setting)
{
    const AcquireOptions usual;
    return setting == NormalSetting{usual.normals.method, usual.lights.given};
}

bool isDefault(const BrdfSetting& setting)
{
    const InterpolationOptions usual;
    return setting == BrdfSetting{usual.method, usual.k, 0, TexelFormat::rgba32f};
}

std::string describe(const NormalRow& row)
{
    return fmt::format("{}, {} lights", nameOf(row.setting.method), row.photographs);
}

std::string describe(const BrdfRow& row)
{
    return fmt::format("k {}, {}x{}x{} {}", row.setting.k, row.size.x, row.size.y, row.size.z,
                       nameOf(row.setting.format));
}

std::string describe(const RenderingSetting& setting)
{
    return !setting.isBall            ? "direct"
           : setting.size.display > 0 ? fmt::format("ball {}/{}", setting.size.radiance, setting.size.display)
                                      : "ball auto";
}

} // namespace nacre
