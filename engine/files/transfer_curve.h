#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace nacre {

// The curve between a file's numbers and linear light.
struct TransferCurve {
    static const TransferCurve linear, srgb;

    std::string name; // for the user
    // Linear light at equal steps of the file's numbers from 0 to full scale, between which lines lead and beyond which
    // the last one goes on; empty for the two above.
    std::vector<float> table;

    bool operator==(const TransferCurve&) const = default;
};

inline const TransferCurve TransferCurve::linear{"linear", {}}, TransferCurve::srgb{"sRGB", {}};

// Light is the number's power; sRGB where both hardly differ (2.2), linear for 1.
TransferCurve powerCurve(double exponent);

TransferCurve adobeRgbCurve();

// Its values at equal steps from 0 to 1, so fine that lines between them err by 2e-8 for a power.
std::vector<float> sampledCurve(const std::function<double(double)>& curve);

// A table, or one of the two above that it hardly differs from.
TransferCurve tabulatedCurve(std::string name, std::vector<float> table);

void decodeCurve(std::span<float> values, const TransferCurve& curve);

} // namespace nacre
