#include "engine/files/transfer_curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shared/shading.h"

namespace nacre {

namespace {

constexpr size_t kCurveSteps = 4096;
constexpr float kSameCurve = 1 / 255.f; // tables within one code of 8 bits are one curve

bool isNear(const std::vector<float>& table, float (*curve)(float))
{
    const float last = static_cast<float>(table.size() - 1);
    for (size_t i = 0; i < table.size(); ++i) {
        if (!(std::abs(table[i] - curve(static_cast<float>(i) / last)) < kSameCurve)) {
            return false;
        }
    }
    return true;
}

float interpolated(const std::vector<float>& table, float value)
{
    const float last = static_cast<float>(table.size() - 1), at = value * last;
    const size_t before = static_cast<size_t>(std::clamp(std::floor(at), 0.0f, last - 1));
    return table[before] + (at - static_cast<float>(before)) * (table[before + 1] - table[before]);
}

} // namespace

std::vector<float> sampledCurve(const std::function<double(double)>& curve)
{
    std::vector<float> table(kCurveSteps + 1);
    for (size_t i = 0; i <= kCurveSteps; ++i) {
        table[i] = static_cast<float>(curve(static_cast<double>(i) / kCurveSteps));
    }
    return table;
}

TransferCurve powerCurve(double exponent)
{
    return tabulatedCurve(fmt::format("power {:.3g}", exponent),
                          sampledCurve([=](double x) { return std::pow(x, exponent); }));
}

TransferCurve adobeRgbCurve()
{
    constexpr double kExponent = 563.0 / 256; // Adobe RGB (1998) Color Image Encoding, 2005, 4.3.4.2
    return tabulatedCurve("Adobe RGB's, power 2.2", sampledCurve([](double x) { return std::pow(x, kExponent); }));
}

TransferCurve tabulatedCurve(std::string name, std::vector<float> table)
{
    if (isNear(table, [](float v) { return v; })) {
        return TransferCurve::linear;
    }
    if (isNear(table, linearFromSrgb)) {
        return TransferCurve::srgb;
    }
    return {std::move(name), std::move(table)};
}

void decodeCurve(std::span<float> values, const TransferCurve& curve)
{
    if (curve == TransferCurve::srgb) {
        std::transform(values.begin(), values.end(), values.begin(), linearFromSrgb);
    } else if (!curve.table.empty()) {
        std::transform(values.begin(), values.end(), values.begin(),
                       [&](float value) { return interpolated(curve.table, value); });
    }
}

} // namespace nacre
