#include "engine/view_state/verdict_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/surface/normal_map.h"

namespace nacre {

Image verdictPicture(std::span<const uint8_t> verdicts, const glm::ivec2& size, int width, int height)
{
    const std::vector<int64_t> from = fittedPixels(size.x, size.y, width, height);
    Image picture(width, height, 3);
    for (size_t i = 0; i < from.size(); ++i) {
        const uint8_t verdict = from[i] < 0 ? kNotJudged : verdicts[static_cast<size_t>(from[i])];
        for (size_t c = 0; verdict < kVerdictKinds.size() && c < 3; ++c) {
            const float code = kVerdictKinds[verdict].colour[static_cast<int>(c)];
            picture.values[3 * i + c] = std::round(255 * code) / 255;
        }
    }
    return picture;
}

std::array<double, kVerdictKinds.size()> verdictShares(std::span<const uint8_t> verdicts)
{
    std::array<double, kVerdictKinds.size()> shares{};
    double judged = 0;
    for (const uint8_t verdict : verdicts) {
        if (verdict < shares.size()) {
            ++shares[verdict];
            ++judged;
        }
    }
    for (double& share : shares) {
        share /= std::max(judged, 1.0);
    }
    return shares;
}

std::string describeVerdicts(std::span<const uint8_t> verdicts)
{
    const auto shares = verdictShares(verdicts);
    std::string text;
    for (size_t i = 0; i < shares.size(); ++i) {
        const VerdictKind& kind = kVerdictKinds[i];
        text += fmt::format("{}{:.1f} % {} (#{:02x}{:02x}{:02x})", text.empty() ? "" : ", ", 100 * shares[i], kind.name,
                            std::lround(255 * kind.colour.r), std::lround(255 * kind.colour.g),
                            std::lround(255 * kind.colour.b));
    }
    return text;
}

} // namespace nacre
