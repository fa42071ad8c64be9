#include "acquisition/self_light/unlit_sides.h"

#include <algorithm>
#include <cmath>

#include "acquisition/self_light/arriving_light.h"

namespace nacre {

namespace {

constexpr float kUnlit = -0.1f; // n.l: 6 degrees behind the light, more than most normals err
constexpr int kFitRounds = 4;   // of strength and albedos in turn; the last ones hardly differ
constexpr int kReweightings = 10;
constexpr double kNearScale = 0.1; // of what is seen: nearer than that, residuals weigh alike
constexpr double kSureErrors = 2;  // standard errors

// An observation of an unlit side over its pixel's bright level.
struct UnlitSide {
    size_t pixel;
    float seen;
    float expected; // a K I, with s = 1
};

std::vector<UnlitSide> unlitSides(const SelfLitPixels& pixels, float strength)
{
    std::vector<UnlitSide> sides;
    for (size_t p = 0; p < pixels.seen.pixelCount(); ++p) {
        const auto seen = pixels.seen.ofPixel(p), arriving = pixels.arriving.ofPixel(p),
                   cosines = pixels.cosines.ofPixel(p);
        const float bright = brightLevel(seen), albedo = selfLitAlbedo(seen, arriving, cosines, strength);
        for (size_t i = 0; bright > 0 && i < seen.size(); ++i) {
            if (cosines[i] < kUnlit && !isClipped(seen[i])) {
                sides.push_back({p, seen[i] / bright, albedo * arriving[i] / bright});
            }
        }
    }
    return sides;
}

// seen = constant + strength * expected.
struct Line {
    double constant = 0;
    double strength = 0;

    double residual(const UnlitSide& side) const { return side.seen - constant - strength * side.expected; }
};

// The least sum of absolute residuals, by reweighted least squares; neither part below 0.
Line fittedLine(const std::vector<UnlitSide>& sides, bool withStrength)
{
    double scale = 0;
    for (const UnlitSide& side : sides) {
        scale += std::abs(side.seen) / static_cast<double>(sides.size());
    }
    Line line;
    for (int step = 0; step < kReweightings; ++step) {
        double ones = 0, x = 0, xx = 1e-12, y = 0, xy = 0;
        for (const UnlitSide& side : sides) {
            const double weight = 1 / (std::abs(line.residual(side)) + kNearScale * scale + 1e-12);
            ones += weight;
            x += weight * side.expected;
            xx += weight * side.expected * side.expected;
            y += weight * side.seen;
            xy += weight * side.expected * side.seen;
        }
        const double determinant = ones * xx - x * x;
        const bool both = withStrength && determinant > 1e-9 * ones * xx;
        line.strength = both ? std::max(0.0, (ones * xy - x * y) / determinant) : 0;
        line.constant = std::max(0.0, (y - line.strength * x) / ones);
        line.strength = both && line.constant == 0 ? std::max(0.0, xy / xx) : line.strength;
    }
    return line;
}

bool isAboveChance(const std::vector<double>& gains)
{
    double sum = 0, squares = 0;
    for (const double gain : gains) {
        sum += gain;
        squares += gain * gain;
    }
    const double count = static_cast<double>(gains.size()), mean = sum / count;
    return mean > kSureErrors * std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
}

} // namespace

UnlitFit fitUnlitSides(const SelfLitPixels& pixels)
{
    UnlitFit fit;
    std::vector<UnlitSide> sides;
    Line line;
    for (int round = 0; round < kFitRounds; ++round) {
        sides = unlitSides(pixels, fit.strength);
        line = fittedLine(sides, true);
        fit.strength = static_cast<float>(line.strength);
    }
    if (sides.empty()) {
        return fit;
    }
    const Line constant = fittedLine(sides, false);
    std::vector<double> gains(pixels.seen.pixelCount(), 0.0);
    double before = 0, after = 0;
    for (const UnlitSide& side : sides) {
        const double without = std::abs(constant.residual(side)), with = std::abs(line.residual(side));
        before += without;
        after += with;
        gains[side.pixel] += without - with;
    }
    fit.explained = before > 0 ? 1 - after / before : 0;
    fit.isSure = isAboveChance(gains);
    return fit;
}

} // namespace nacre
