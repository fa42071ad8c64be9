#pragma once
#include <string>
#include <vector>

namespace nacre {

struct ChartAxis {
    std::string label; // with its unit
    bool isLog = false;
    bool isLessBetter = true; // otherwise values are decibels, and more is better
};

// An axis between two values, with the values that are written beside it.
class ChartScale {
public:
    // Of values that isPlottable takes; at least one. A log axis ends at ticks or close beyond the values.
    ChartScale(const std::vector<double>& values, bool isLog);

    double position(double value) const; // 0 at the axis's start, 1 at its end
    const std::vector<double>& ticks() const { return ticks_; }

private:
    double transformed(double value) const;
    void placeLogTicks();
    void placeLinearTicks();

    bool isLog_;
    double first_, last_; // transformed
    std::vector<double> ticks_;
};

// Finite, and on a log axis above 0.
bool isPlottable(double value, bool isLog);

// At most four digits, with k, M, G for thousands: "0.05", "20", "1.5M".
std::string tickText(double value);

} // namespace nacre
