#include "acquisition/segmentation/material_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

#include "acquisition/segmentation/label_regions.h"
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

namespace {

using Members = std::vector<uint32_t>; // indices of traits

constexpr size_t kMostFound = 8;
constexpr int kDirections = 8;
constexpr float kLobeShows = 0.26f;           // logarithm of 1.3, over the matte level
constexpr size_t kFewestInGroup = 30;         // pixels
constexpr double kLeastMaterialShare = 0.005; // of the object
constexpr float kLeastChromaticityError = 0.004f, kAlbedoScatter = 0.05f, kLobeScatter = 0.07f;

// Ways to halve a group, the surest first: only where none of the first kind is left does the next count.
enum class Kind { chromaticity, albedo, lobe, scatter };

struct Halving {
    Kind kind = Kind::scatter;
    double depth = 1; // of the valley; minus the gain for scatter: smaller is better
    Members low, high;
    Members untold; // the lobe does not show there
};

bool isBetter(const Halving& a, const Halving& b)
{
    return a.kind != b.kind ? a.kind < b.kind : a.depth < b.depth;
}

Halving halvedAt(Kind kind, double depth, const Members& members, const std::vector<float>& values, float threshold)
{
    Halving halving{kind, depth, {}, {}, {}};
    for (size_t i = 0; i < members.size(); ++i) {
        Members& side = std::isnan(values[i]) ? halving.untold : values[i] < threshold ? halving.low : halving.high;
        side.push_back(members[i]);
    }
    return halving;
}

std::vector<float> told(const std::vector<float>& values)
{
    std::vector<float> kept;
    std::copy_if(values.begin(), values.end(), std::back_inserter(kept), [](float v) { return !std::isnan(v); });
    return kept;
}

class Halver {
public:
    explicit Halver(const std::vector<PixelTraits>& traits)
        : traits_(traits),
          fewest_(
              std::max(kFewestInGroup, static_cast<size_t>(kLeastMaterialShare * static_cast<double>(traits.size()))))
    {
    }

    // By a valley; none where there is no clear one.
    std::optional<Halving> byValley(const Members& members) const
    {
        if (auto halving = byChromaticity(members)) {
            return halving;
        }
        if (auto halving = byValues(Kind::albedo, members, albedos(members), {kAlbedoScatter, 0.47f, 0.2, fewest_})) {
            return halving;
        }
        return byValues(Kind::lobe, members, relativeLobes(members), {kLobeScatter, 0.4f, 0.25, fewest_});
    }

    // About the mean of chromaticity or albedo, whichever scatters more beyond what counts as equal.
    std::optional<Halving> byScatter(const Members& members) const
    {
        std::optional<Halving> best;
        const auto consider = [&](const std::vector<float>& values, float scatter) {
            double sum = 0, squares = 0;
            for (const float v : values) {
                sum += v;
                squares += static_cast<double>(v) * v;
            }
            const double count = static_cast<double>(values.size()), mean = sum / count;
            const double variance = squares / count - mean * mean;
            Halving halving = halvedAt(Kind::scatter, -count * variance / (scatter * scatter), members, values,
                                       static_cast<float>(mean));
            if (!halving.low.empty() && !halving.high.empty() && (!best || isBetter(halving, *best))) {
                best = std::move(halving);
            }
        };
        for (int d = 0; d < kDirections; ++d) {
            consider(chromaticities(members, d), kLeastChromaticityError * 5);
        }
        consider(albedos(members), kAlbedoScatter * 10);
        return best;
    }

private:
    std::vector<float> chromaticities(const Members& members, int direction) const
    {
        const float angle = static_cast<float>(direction) * std::numbers::pi_v<float> / kDirections;
        const glm::vec2 axis(std::cos(angle), std::sin(angle));
        std::vector<float> values;
        for (const uint32_t i : members) {
            values.push_back(glm::dot(traits_[i].chromaticity, axis));
        }
        return values;
    }

    std::vector<float> albedos(const Members& members) const
    {
        std::vector<float> values;
        for (const uint32_t i : members) {
            values.push_back(traits_[i].logAlbedo);
        }
        return values;
    }

    // A pixel's lobe as a share of what the group's glossier pixels show at the same thetaH: 1 as glossy, 0 matte. NaN
    // where the pixel sees none of the bins in which the group shows a lobe at all.
    std::vector<float> relativeLobes(const Members& members) const
    {
        std::vector<float> sum(members.size(), 0), most(members.size(), 0);
        for (int bin = 0; bin < kLobeBins; ++bin) {
            std::vector<float> seen;
            for (const uint32_t i : members) {
                if (traits_[i].lobeSeen >> bin & 1) {
                    seen.push_back(traits_[i].lobe[bin]);
                }
            }
            // Half of the pixels may have no lobe, so the upper quarter decides.
            const float glossy = seen.size() < kFewestInGroup ? 0 : quantile(seen, 0.75);
            for (size_t m = 0; m < members.size() && glossy > kLobeShows; ++m) {
                if (traits_[members[m]].lobeSeen >> bin & 1) {
                    sum[m] += traits_[members[m]].lobe[bin];
                    most[m] += glossy;
                }
            }
        }
        for (size_t m = 0; m < members.size(); ++m) {
            sum[m] = most[m] > 0 ? sum[m] / most[m] : std::numeric_limits<float>::quiet_NaN();
        }
        return sum;
    }

    std::optional<Halving> byValues(Kind kind, const Members& members, const std::vector<float>& values,
                                    const ValleyOptions& options) const
    {
        const std::optional<Valley> valley = deepestValley(told(values), options);
        if (!valley) {
            return {};
        }
        return halvedAt(kind, valley->depth, members, values, valley->threshold);
    }

    std::optional<Halving> byChromaticity(const Members& members) const
    {
        std::vector<float> errors;
        for (const uint32_t i : members) {
            errors.push_back(traits_[i].chromaticityError);
        }
        const float error = std::max(kLeastChromaticityError, quantile(errors, 0.5));
        std::optional<Halving> best;
        for (int d = 0; d < kDirections; ++d) {
            auto halving = byValues(Kind::chromaticity, members, chromaticities(members, d),
                                    {error, std::max(0.025f, 4 * error), 0.5, fewest_});
            if (halving && (!best || isBetter(*halving, *best))) {
                best = std::move(halving);
            }
        }
        return best;
    }

    const std::vector<PixelTraits>& traits_;
    size_t fewest_;
};

struct Group {
    Members members;
    std::optional<Halving> halving;
};

// The group that is to be halved next, by valleys alone or by scatter as well.
Group* nextGroup(std::vector<Group>& groups)
{
    Group* next = nullptr;
    for (Group& group : groups) {
        if (group.halving && (!next || isBetter(*group.halving, *next->halving))) {
            next = &group;
        }
    }
    return next;
}

} // namespace

FoundMaterials findMaterials(const std::vector<PixelTraits>& traits, size_t count)
{
    const Halver halver(traits);
    const auto grouped = [&](Members members) {
        Group group{std::move(members), {}};
        group.halving = halver.byValley(group.members);
        if (!group.halving && count > 0) {
            group.halving = halver.byScatter(group.members);
        }
        return group;
    };
    Members all(traits.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<Group> groups;
    if (!traits.empty()) {
        groups.push_back(grouped(std::move(all)));
    }
    const size_t most = count > 0 ? count : kMostFound;
    for (Group* next = nextGroup(groups); next && groups.size() < most; next = nextGroup(groups)) {
        Halving halving = std::move(*next->halving);
        *next = grouped(std::move(halving.low));
        groups.push_back(grouped(std::move(halving.high)));
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.members.size() > b.members.size(); });
    FoundMaterials found{std::vector<uint8_t>(traits.size(), kUnlabelled), std::max<size_t>(1, groups.size())};
    for (size_t g = 0; g < groups.size(); ++g) {
        for (const uint32_t i : groups[g].members) {
            found.labels[i] = static_cast<uint8_t>(g);
        }
    }
    return found;
}

} // namespace nacre
