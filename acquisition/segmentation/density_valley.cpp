#include "acquisition/segmentation/density_valley.h"

#include <algorithm>
#include <cmath>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr int kStepsPerBandwidth = 4;
constexpr double kOutliers = 0.001; // share at either end that the grid does not follow
constexpr size_t kMostCells = 4096;

struct Density {
    float first = 0, step = 1;  // value of cell 0, and between cells
    std::vector<double> counts; // values per cell
    std::vector<double> smooth; // values within a bandwidth
};

Density densityOf(const std::vector<float>& values, float bandwidth)
{
    std::vector<float> sorted = values;
    const float low = quantile(sorted, kOutliers) - 3 * bandwidth;
    const float high = quantile(sorted, 1 - kOutliers) + 3 * bandwidth;
    Density density;
    density.first = low;
    density.step = std::max(bandwidth / kStepsPerBandwidth, (high - low) / kMostCells);
    density.counts.assign(static_cast<size_t>((high - low) / density.step) + 1, 0);
    for (const float value : values) {
        const float cell = (std::clamp(value, low, high) - low) / density.step;
        ++density.counts[std::min(density.counts.size() - 1, static_cast<size_t>(cell))];
    }
    density.smooth.assign(density.counts.size(), 0);
    const int reach = 3 * kStepsPerBandwidth, cells = static_cast<int>(density.counts.size());
    for (int i = 0; i < cells; ++i) {
        for (int j = std::max(0, i - reach); j <= std::min(cells - 1, i + reach); ++j) {
            const double away = (i - j) / static_cast<double>(kStepsPerBandwidth);
            density.smooth[i] += density.counts[j] * std::exp(-0.5 * away * away);
        }
    }
    return density;
}

// Cells of the highest density at or before each cell.
std::vector<size_t> peaksBefore(const std::vector<double>& smooth)
{
    std::vector<size_t> peak(smooth.size(), 0);
    for (size_t i = 1; i < smooth.size(); ++i) {
        peak[i] = smooth[i] > smooth[peak[i - 1]] ? i : peak[i - 1];
    }
    return peak;
}

std::vector<size_t> peaksAfter(const std::vector<double>& smooth)
{
    std::vector<size_t> peak(smooth.size(), smooth.size() - 1);
    for (size_t i = smooth.size() - 1; i-- > 0;) {
        peak[i] = smooth[i] > smooth[peak[i + 1]] ? i : peak[i + 1];
    }
    return peak;
}

} // namespace

std::optional<Valley> deepestValley(const std::vector<float>& values, const ValleyOptions& options)
{
    if (values.size() < 2 * options.fewest || values.size() < 2) {
        return {};
    }
    const Density density = densityOf(values, options.bandwidth);
    const std::vector<double>& smooth = density.smooth;
    const std::vector<size_t> left = peaksBefore(smooth), right = peaksAfter(smooth);
    std::optional<Valley> best;
    size_t firstBest = 0;
    double below = 0;
    for (size_t i = 0; i < smooth.size(); ++i) {
        below += density.counts[i];
        const double lower = std::min(smooth[left[i]], smooth[right[i]]), depth = smooth[i] / lower;
        const float gap = static_cast<float>(right[i] - left[i]) * density.step;
        const double smaller = std::min(below, static_cast<double>(values.size()) - below);
        const bool isValley = depth < options.deepest && gap >= options.leastGap &&
                              smaller >= static_cast<double>(options.fewest) &&
                              lower - smooth[i] > 4 * std::sqrt(lower);
        if (isValley && (!best || depth < best->depth)) {
            best = Valley{0, depth, gap};
            firstBest = i;
        }
        if (best && isValley && depth <= best->depth) { // the middle of an empty stretch
            best->threshold = density.first + density.step * (static_cast<float>(firstBest + i) / 2 + 1);
        }
    }
    return best;
}

} // namespace nacre
