#include "evaluation/charts/candidate_order.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "evaluation/charts/pareto_front.h"

namespace nacre {

namespace {

// A setting's costs as ratios within each capture: seconds to the slowest setting's, error to the least.
template <class Setting> struct SettingCost {
    Setting setting;
    double logSeconds = 0, logError = 0; // sums over captures
    int captures = 0;
};

struct Measured {
    double seconds = 0;
    double error = 0;
};

double errorBehind(double decibels)
{
    return std::pow(10.0, -decibels / 20);
}

// The cost of every setting, in the order in which they first come, and the geometric mean of the captures' slowest.
template <class Row, class Setting> class CostTable {
public:
    void add(const std::vector<std::pair<Setting, Measured>>& capture)
    {
        double slowest = 0, least = INFINITY;
        for (const auto& [setting, cost] : capture) {
            slowest = std::max(slowest, cost.seconds);
            least = std::min(least, cost.error);
        }
        if (capture.empty() || !(slowest > 0) || !(least > 0)) {
            return;
        }
        logSlowest_ += std::log(slowest);
        ++captures_;
        for (const auto& [setting, cost] : capture) {
            SettingCost<Setting>& sum = of(setting);
            sum.logSeconds += std::log(std::max(cost.seconds, 1e-6) / slowest);
            sum.logError += std::log(cost.error / least);
            ++sum.captures;
        }
    }
    const std::vector<SettingCost<Setting>>& settings() const { return settings_; }
    Measured meanOf(const SettingCost<Setting>& cost) const
    {
        return {std::exp(cost.logSeconds / cost.captures + logSlowest_ / captures_),
                std::exp(cost.logError / cost.captures)};
    }

private:
    SettingCost<Setting>& of(const Setting& setting)
    {
        const auto found = std::find_if(settings_.begin(), settings_.end(),
                                        [&](const auto& known) { return known.setting == setting; });
        return found == settings_.end() ? settings_.emplace_back(SettingCost<Setting>{setting}) : *found;
    }

    std::vector<SettingCost<Setting>> settings_;
    double logSlowest_ = 0;
    int captures_ = 0;
};

using NormalCosts = CostTable<NormalRow, NormalSetting>;
using BrdfCosts = CostTable<BrdfRow, BrdfSetting>;

NormalCosts normalCosts(const std::vector<NormalRow>& rows)
{
    std::map<std::string, std::vector<std::pair<NormalSetting, Measured>>> captures;
    for (const NormalRow& row : rows) {
        if (row.refusal.empty()) {
            captures[row.capture].push_back(
                {row.setting, {row.seconds, row.hasTruth ? row.error.mean : errorBehind(row.psnr)}});
        }
    }
    NormalCosts costs;
    for (const auto& [name, capture] : captures) {
        costs.add(capture);
    }
    return costs;
}

// Formats cost no time: tables of full precision stand for all.
BrdfCosts brdfCosts(const std::vector<BrdfRow>& rows)
{
    std::map<std::string, std::vector<std::pair<BrdfSetting, Measured>>> captures;
    for (const BrdfRow& row : rows) {
        if (row.setting.format == TexelFormat::rgba32f) {
            captures[row.capture].push_back({row.setting, {row.seconds, errorBehind(row.psnr)}});
        }
    }
    BrdfCosts costs;
    for (const auto& [name, capture] : captures) {
        costs.add(capture);
    }
    return costs;
}

glm::ivec3 texelsOf(const BrdfSetting& setting, const std::vector<BrdfRow>& rows)
{
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const BrdfRow& row) { return row.setting == setting; });
    return setting.size == 0 || found == rows.end() ? glm::ivec3(0) : found->size;
}

std::string nameInSource(NormalMethod method)
{
    switch (method) {
    case NormalMethod::leastSquares:
        return "leastSquares";
    case NormalMethod::threshold:
        return "threshold";
    case NormalMethod::twoStep:
        return "twoStep";
    case NormalMethod::ransac:
        return "ransac";
    case NormalMethod::consensus:
        return "consensus";
    case NormalMethod::exemplar:
        return "exemplar";
    case NormalMethod::automatic:
        break;
    }
    return "automatic";
}

// Candidates on the front, from the quickest on; of those that cost about the same, the best.
std::vector<AcquireCandidate> frontFrom(const std::vector<AcquireCandidate>& all, const std::vector<double>& errors)
{
    constexpr double kLeastGain = 0.03, kLeastStep = 0.1;
    std::vector<Cost> costs;
    std::vector<size_t> order;
    for (size_t i = 0; i < all.size(); ++i) {
        costs.push_back({all[i].seconds, errors[i]});
        order.push_back(i);
    }
    const std::vector<char> front = paretoFront(costs);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return all[a].seconds < all[b].seconds; });
    std::vector<AcquireCandidate> chosen;
    double lastError = INFINITY, stepSeconds = 0;
    for (const size_t i : order) {
        if (!front[i]) {
            continue;
        }
        if (!chosen.empty() && all[i].seconds < (1 + kLeastStep) * stepSeconds) {
            chosen.back() = all[i];
            lastError = errors[i];
        } else if (errors[i] < (1 - kLeastGain) * lastError) {
            chosen.push_back(all[i]);
            lastError = errors[i];
            stepSeconds = all[i].seconds;
        }
    }
    return chosen;
}

} // namespace

std::vector<AcquireCandidate> candidateOrder()
{
    return {
#include "evaluation/charts/candidate_order.inc"
    };
}

std::vector<AcquireCandidate> candidatesFrom(const ChartRows& rows)
{
    const NormalCosts normals = normalCosts(rows.normals);
    const BrdfCosts brdf = brdfCosts(rows.brdf);
    std::vector<AcquireCandidate> all;
    std::vector<double> errors;
    for (const auto& normal : normals.settings()) {
        for (const auto& table : brdf.settings()) {
            const Measured first = normals.meanOf(normal), second = brdf.meanOf(table);
            all.push_back({normal.setting.method, normal.setting.lightsGiven, table.setting.interpolation,
                           table.setting.k, texelsOf(table.setting, rows.brdf), first.seconds + second.seconds});
            errors.push_back(first.error * second.error);
        }
    }
    if (all.empty()) {
        throw Error("", "an order needs settings of normals and of the BRDF", "--parts with normals and brdf",
                    Error::kUsage);
    }
    return frontFrom(all, errors);
}

std::string sourceOf(const std::vector<AcquireCandidate>& candidates)
{
    std::string text =
        "// Made by nacre chart --write-order: method, lights given, interpolation, k, texels, seconds.\n";
    for (const AcquireCandidate& c : candidates) {
        text += fmt::format("{{NormalMethod::{}, {}, InterpolationMethod::{}, {}, {{{}, {}, {}}}, {:.3f}}},\n",
                            nameInSource(c.method), c.lightsGiven,
                            c.interpolation == InterpolationMethod::paper ? "paper" : "localLinear", c.k, c.tableSize.x,
                            c.tableSize.y, c.tableSize.z, c.seconds);
    }
    return text;
}

AcquireOptions optionsOf(const AcquireCandidate& candidate, AcquireOptions options)
{
    options.normals.method = candidate.method;
    options.lights.given = candidate.lightsGiven;
    options.interpolation.method = candidate.interpolation;
    options.interpolation.k = candidate.k;
    options.bake.size = candidate.tableSize;
    return options;
}

std::string commandLineOf(const AcquireCandidate& candidate)
{
    std::string text = "--normals " + nameOf(candidate.method);
    if (candidate.lightsGiven > 0) {
        text += fmt::format(" --lights-given {}", candidate.lightsGiven);
    }
    text += fmt::format(" --interpolation {} --k {}", nameOf(candidate.interpolation), candidate.k);
    const glm::ivec3& size = candidate.tableSize;
    return size.x > 0 ? text + fmt::format(" --table-size {},{},{}", size.x, size.y, size.z) : text;
}

} // namespace nacre
