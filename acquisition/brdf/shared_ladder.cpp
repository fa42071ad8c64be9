#include "acquisition/brdf/shared_ladder.h"

#include <algorithm>
#include <limits>
#include <map>

#include "acquisition/brdf/model_candidates.h"
#include "acquisition/brdf/shared_basis.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kSharedRanks[] = {1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};
constexpr size_t kMostValues = size_t{32} << 20; // that a fit holds

struct Candidate {
    glm::ivec3 size;
    int rank;
    size_t bytes;
};

// The largest grid and range of the members.
BrdfTable commonGrid(std::span<const ModelJudge> judges)
{
    BrdfTable common;
    common.domain = judges.front().table().domain;
    for (const ModelJudge& judge : judges) {
        common.size = glm::max(common.size, judge.table().size);
        common.domain.thetaDMax = std::max(common.domain.thetaDMax, judge.table().domain.thetaDMax);
    }
    return common;
}

size_t texelsOf(const glm::ivec3& size)
{
    return static_cast<size_t>(size.x) * size.y * size.z;
}

std::vector<Candidate> candidatesOf(const glm::ivec3& full, size_t members, size_t mostBytes)
{
    std::vector<Candidate> candidates;
    for (const glm::ivec3& size : candidateSizes(full)) {
        for (const int rank : kSharedRanks) {
            const size_t bytes = static_cast<size_t>(rank) * (2 * texelsOf(size) + 3 * sizeof(float) * members);
            if (static_cast<size_t>(rank) <= 3 * members && bytes <= mostBytes &&
                3 * members * texelsOf(size) <= kMostValues) {
                candidates.push_back({size, rank, bytes});
            }
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.bytes < b.bytes; });
    return candidates;
}

// Bases by the grid's size, of as many components as any candidate asks for; made when first asked for.
class Bases {
public:
    Bases(std::span<const ModelJudge> judges, const TableDomain& domain, int rank)
        : judges_(judges), domain_(domain), rank_(rank)
    {
    }

    std::vector<BasisBrdf> models(const Candidate& candidate)
    {
        const std::array<int, 3> key{candidate.size.x, candidate.size.y, candidate.size.z};
        const auto found = fits_.find(key);
        return truncated(found != fits_.end() ? found->second : fits_[key] = fit(candidate.size), candidate.rank);
    }

private:
    std::vector<BasisBrdf> fit(const glm::ivec3& size) const
    {
        std::vector<BrdfTable> tables;
        std::vector<BasisMember> members;
        tables.reserve(judges_.size());
        for (const ModelJudge& judge : judges_) {
            tables.push_back(resampledTable(judge.table(), size, domain_));
            members.push_back({&tables.back(), judge.peak()});
        }
        return fitBasis(members, rank_);
    }

    std::span<const ModelJudge> judges_;
    TableDomain domain_;
    int rank_;
    std::map<std::array<int, 3>, std::vector<BasisBrdf>> fits_;
};

double leastPsnr(std::span<const ModelJudge> judges, const std::vector<BasisBrdf>& models, int threads)
{
    std::vector<double> psnr(judges.size());
    parallelFor(judges.size(), 1, threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            psnr[i] = judges[i].judge(models[i]).psnr;
        }
    });
    return *std::min_element(psnr.begin(), psnr.end());
}

bool canShare(std::span<const ModelJudge> judges)
{
    return judges.size() > 1 && std::all_of(judges.begin(), judges.end(), [&](const ModelJudge& judge) {
               return !judge.isEmpty() && judge.table().domain.coordinates == judges.front().table().domain.coordinates;
           });
}

} // namespace

SharedLadder climbSharedLadder(std::span<const ModelJudge> judges, const SharedStep& apart,
                               const LadderOptions& options)
{
    SharedLadder ladder{apart, {}, {}, {}};
    if (!canShare(judges)) {
        return ladder;
    }
    const bool byTolerance = options.toleranceDecibels > 0;
    const size_t budget = options.budgetBytes > 0 ? options.budgetBytes * judges.size() : apart.bytes;
    const BrdfTable common = commonGrid(judges);
    const std::vector<Candidate> candidates =
        candidatesOf(common.size, judges.size(), byTolerance ? std::min(budget, apart.bytes) : budget);
    int rank = 0;
    for (const Candidate& candidate : candidates) {
        rank = std::max(rank, candidate.rank);
    }
    Bases bases(judges, common.domain, rank);
    double best = byTolerance ? options.toleranceDecibels : apart.leastPsnr;
    for (const Candidate& candidate : candidates) {
        std::vector<BasisBrdf> models = bases.models(candidate);
        ladder.steps.push_back({describe(models.front()), candidate.bytes, leastPsnr(judges, models, options.threads)});
        if (ladder.steps.back().leastPsnr > best) {
            best = ladder.steps.back().leastPsnr;
            ladder.taken = ladder.steps.size() - 1;
            ladder.models = std::move(models);
            if (byTolerance) {
                break;
            }
        }
    }
    return ladder;
}

} // namespace nacre
