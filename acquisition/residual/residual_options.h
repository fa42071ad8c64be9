#pragma once
#include <cstddef>

namespace nacre {

// automatic keeps the layer only where leaving photographs out says that it pays.
enum class ResidualChoice { automatic, none, difference };

struct ResidualOptions {
    ResidualChoice choice = ResidualChoice::none;
    double toleranceDecibels = 0; // as many components as reach this PSNR at the captured lights; 0: not asked
    size_t budgetBytes = 0;       // at most so many bytes; 0: not asked
    int threads = 0;
};

} // namespace nacre
