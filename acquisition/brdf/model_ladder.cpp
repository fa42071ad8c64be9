#include "acquisition/brdf/model_ladder.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

constexpr float kIor = 1.5f;
// B sets the lobe's width (1 / sqrt(B) radians), C its tail.
constexpr float kFirstB = 3, kLastB = 1e6f, kBStep = 3;
constexpr float kTails[] = {0.5f, 0.8f, 1.2f, 1.8f, 2.7f, 4, 6};
constexpr int kRefinements = 5;

struct Fit {
    AbcModel model;
    double error = std::numeric_limits<double>::max();
};

AbcModel lobeOf(float B, float C)
{
    AbcModel model;
    model.kD = glm::vec3(0);
    model.A = glm::vec3(1);
    model.B = B;
    model.C = C;
    model.ior = kIor;
    return model;
}

// min |w (f - d / pi - a s)| with d, a >= 0, of one channel: the unconstrained solution, or one of the borders.
struct Channel {
    double dd = 0, ds = 0, ss = 0, df = 0, sf = 0, ff = 0;

    double errorOf(double d, double a) const
    {
        return ff - 2 * (d * df + a * sf) + d * d * dd + 2 * d * a * ds + a * a * ss;
    }
    double solve(float& diffuse, float& specular) const
    {
        const double determinant = dd * ss - ds * ds;
        double d = 0, a = 0;
        if (determinant > 1e-9 * dd * ss) {
            d = (df * ss - sf * ds) / determinant;
            a = (sf * dd - df * ds) / determinant;
        }
        if (!(d >= 0 && a >= 0 && d + a > 0)) {
            const double dAlone = dd > 0 ? std::max(0.0, df / dd) : 0, aAlone = ss > 0 ? std::max(0.0, sf / ss) : 0;
            const bool diffuseWins = errorOf(dAlone, 0) <= errorOf(0, aAlone);
            d = diffuseWins ? dAlone : 0;
            a = diffuseWins ? 0 : aAlone;
        }
        diffuse = static_cast<float>(d);
        specular = static_cast<float>(a);
        return errorOf(d, a);
    }
};

Fit fitAmplitudes(const std::vector<BrdfMeasurement>& measurements, const AbcModel& lobe)
{
    Channel channels[3];
    for (const BrdfMeasurement& m : measurements) {
        const double weight = static_cast<double>(m.weight) * m.weight, diffuse = 1 / kPi;
        const double shape = evaluate(lobe, m.n, m.l, m.v).x;
        for (int c = 0; c < 3; ++c) {
            Channel& channel = channels[c];
            channel.dd += weight * diffuse * diffuse;
            channel.ds += weight * diffuse * shape;
            channel.ss += weight * shape * shape;
            channel.df += weight * diffuse * m.f[c];
            channel.sf += weight * shape * m.f[c];
            channel.ff += weight * m.f[c] * m.f[c];
        }
    }
    Fit fit{lobe, 0};
    for (int c = 0; c < 3; ++c) {
        fit.error += channels[c].solve(fit.model.kD[c], fit.model.A[c]);
    }
    return fit;
}

void tryLobe(const std::vector<BrdfMeasurement>& measurements, float B, float C, Fit& best)
{
    const Fit fit = fitAmplitudes(measurements, lobeOf(B, C));
    if (fit.error < best.error) {
        best = fit;
    }
}

// Sizes of tables tried, as shares of the full one's.
struct Shrink {
    float thetaH, thetaD, phiD;
};
constexpr Shrink kVolumes[] = {{1, 1, 1},           {1, 0.5f, 0.5f},     {1, 0.35f, 0.4f},    {0.7f, 0.5f, 0.5f},
                               {0.7f, 0.25f, 0.2f}, {0.5f, 0.25f, 0.2f}, {0.35f, 0.2f, 0.2f}, {0.25f, 0.15f, 0.13f}};
constexpr Shrink kPlanes[] = {{1, 1, 0}, {1, 0.5f, 0}, {1, 0.2f, 0}, {0.5f, 0.2f, 0}, {0.25f, 0.15f, 0}};

glm::ivec3 shrunk(const glm::ivec3& size, const Shrink& shrink)
{
    const auto axis = [](int texels, float share) {
        return share > 0 ? std::clamp(static_cast<int>(std::lround(texels * share)), 2, texels) : 1;
    };
    return {axis(size.x, shrink.thetaH), axis(size.y, shrink.thetaD), axis(size.z, shrink.phiD)};
}

// f(thetaH, thetaD): the mean over phiD of what is covered.
BrdfTable bivariateOf(const BrdfTable& full)
{
    BrdfTable plane({full.size.x, full.size.y, 1}, full.domain);
    for (int j = 0; j < full.size.y; ++j) {
        for (int i = 0; i < full.size.x; ++i) {
            glm::vec3 sum(0);
            float weights = 0, confidence = 0;
            for (int k = 0; k < full.size.z; ++k) {
                const size_t texel = full.index(i, j, k);
                const float weight = std::max(full.confidence[texel], 1e-3f);
                sum += weight * full.values[texel];
                weights += weight;
                confidence += full.confidence[texel];
            }
            plane.values[plane.index(i, j, 0)] = sum / weights;
            plane.confidence[plane.index(i, j, 0)] = confidence / static_cast<float>(full.size.z);
        }
    }
    return plane;
}

// Models of one material from Lambert to its full table: fits of formulas, bivariate and full tables of falling sizes
// in each format.
std::vector<CompactBrdf> candidateModels(const ModelJudge& judge)
{
    const BrdfTable& full = judge.table();
    const std::vector<BrdfMeasurement> fitted = judge.fittedPart();
    std::vector<CompactBrdf> candidates{FittedLobe{fitLambert(fitted)}, FittedLobe{fitLobe(fitted)}};
    const auto addTable = [&](const BrdfTable& from, const glm::ivec3& size) {
        const BrdfTable table = size == from.size ? from : resampledTable(from, size, from.domain);
        for (const auto format : {TexelFormat::rgba32f, TexelFormat::rgba16f, TexelFormat::e5b9g9r9}) {
            SmallTable small{table, format};
            for (glm::vec3& value : small.table.values) {
                value = quantised(value, format);
            }
            candidates.emplace_back(std::move(small));
        }
    };
    if (full.domain.coordinates != kNatural) {
        const BrdfTable plane = bivariateOf(full);
        for (const Shrink& shrink : kPlanes) {
            addTable(plane, shrunk(full.size, shrink));
        }
    }
    for (const Shrink& shrink : kVolumes) {
        addTable(full, shrunk(full.size, shrink));
    }
    return candidates;
}

std::optional<size_t> chosenStep(const std::vector<LadderStep>& steps, const LadderOptions& options)
{
    std::optional<size_t> best;
    for (size_t i = 0; i < steps.size(); ++i) {
        const bool fits = options.budgetBytes == 0 || steps[i].bytes <= options.budgetBytes;
        const bool good = options.toleranceDecibels <= 0 || steps[i].psnr >= options.toleranceDecibels;
        // By tolerance the first will do, since steps go by bytes; by budget alone the best.
        const bool better = !best || (options.toleranceDecibels <= 0 && steps[i].psnr > steps[*best].psnr);
        if (fits && good && better) {
            best = i;
        }
    }
    return best;
}

constexpr int kBallSize = 40;   // normals across the disc
constexpr int kLightCount = 16; // spread over the cap of the table's range
constexpr float kLeastCosine = 0.05f;
constexpr float kLeastConfidence = 0.5f;
constexpr size_t kMostFitted = 4000;

std::vector<glm::vec3> judgingLights(const TableDomain& domain)
{
    const float polar = domain.coordinates == kNatural ? kHalfPi : std::min(2 * domain.thetaDMax, kHalfPi);
    const float capHeight = 1 - std::cos(polar);
    const float goldenAngle = kPi * (3 - std::sqrt(5.0f));
    std::vector<glm::vec3> lights;
    for (int i = 0; i < kLightCount; ++i) {
        const float z = 1 - capHeight * (i + 0.5f) / kLightCount, s = std::sqrt(1 - z * z);
        lights.emplace_back(s * std::cos(i * goldenAngle), s * std::sin(i * goldenAngle), z);
    }
    return lights;
}

// Covered configurations of a ball, with what the interpolant says and how an error there shows.
std::vector<BrdfMeasurement> judgesOf(const BrdfInterpolant& interpolant, const BrdfTable& full, int threads)
{
    std::vector<BrdfMeasurement> judges;
    const glm::vec3 v(0, 0, 1);
    const std::vector<glm::vec3> lights = judgingLights(full.domain);
    for (int y = 0; y < kBallSize; ++y) {
        for (int x = 0; x < kBallSize; ++x) {
            const glm::vec2 disc(2 * (x + 0.5f) / kBallSize - 1, 1 - 2 * (y + 0.5f) / kBallSize);
            const float square = glm::dot(disc, disc);
            if (square >= 0.98f) {
                continue;
            }
            const glm::vec3 n(disc, std::sqrt(1 - square));
            for (const glm::vec3& l : lights) {
                const float nDotL = glm::dot(n, l);
                if (nDotL > kLeastCosine && evaluateTable(full, n, l, v).confidence >= kLeastConfidence) {
                    judges.push_back({n, l, v, {}, nDotL});
                }
            }
        }
    }
    parallelFor(judges.size(), 64, threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            judges[i].f = interpolant(unitFromDirections(full.domain, judges[i].n, judges[i].l, v)).value;
        }
    });
    return judges;
}

double brightnessOf(const std::vector<BrdfMeasurement>& judges)
{
    std::vector<float> values;
    for (const BrdfMeasurement& judge : judges) {
        for (int c = 0; c < 3; ++c) {
            values.push_back(judge.f[c] * judge.weight);
        }
    }
    return peakOf(values);
}

// Of this thread's own work: others on the machine do not count.
double threadSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace

AbcModel fitLambert(const std::vector<BrdfMeasurement>& measurements)
{
    AbcModel none = lobeOf(1, 1);
    none.A = glm::vec3(0); // a shape of 0 leaves the diffuse part alone
    AbcModel model = fitAmplitudes(measurements, none).model;
    model.A = glm::vec3(0);
    return model;
}

AbcModel fitLobe(const std::vector<BrdfMeasurement>& measurements)
{
    Fit best;
    for (float B = kFirstB; B <= kLastB; B *= kBStep) {
        for (const float C : kTails) {
            tryLobe(measurements, B, C, best);
        }
    }
    float stepB = std::sqrt(kBStep), stepC = 1.22f;
    for (int round = 0; round < kRefinements; ++round) {
        const float B = best.model.B, C = best.model.C;
        for (const float b : {B / stepB, B, B * stepB}) {
            for (const float c : {C / stepC, C, C * stepC}) {
                tryLobe(measurements, b, c, best);
            }
        }
        stepB = std::sqrt(stepB);
        stepC = std::sqrt(stepC);
    }
    return best.model;
}

ModelLadder climbLadder(const ModelJudge& judge, const LadderOptions& options)
{
    ModelLadder ladder;
    if (judge.isEmpty()) {
        return ladder;
    }
    std::vector<CompactBrdf> candidates = candidateModels(judge);
    ladder.steps.resize(candidates.size());
    parallelFor(candidates.size(), 1, options.threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const ModelJudge::Verdict verdict = judge.judge(candidates[i]);
            ladder.steps[i] = {candidates[i], describe(candidates[i]), bytesOf(candidates[i]), verdict.psnr,
                               verdict.nanoseconds};
        }
    });
    std::stable_sort(ladder.steps.begin(), ladder.steps.end(),
                     [](const LadderStep& a, const LadderStep& b) { return a.bytes < b.bytes; });
    ladder.taken = chosenStep(ladder.steps, options);
    return ladder;
}

ModelJudge::ModelJudge(const BrdfInterpolant& interpolant, const BrdfTable& full, int threads)
    : judges_(judgesOf(interpolant, full, threads)), full_(&full)
{
    if (!judges_.empty()) {
        peak_ = brightnessOf(judges_);
    }
}

ModelJudge::Verdict ModelJudge::judge(const CompactBrdf& compact) const
{
    const auto* lobe = std::get_if<FittedLobe>(&compact);
    const BrdfTable table = lobe ? BrdfTable() : expandedTable(compact, *full_);
    const BrdfModel model = lobe ? BrdfModel(lobe->model) : BrdfModel(LambertGgx{});
    const double start = threadSeconds();
    const double psnr = psnrOf([&](const BrdfMeasurement& j) {
        return lobe ? evaluate(model, j.n, j.l, j.v) : evaluateTable(table, j.n, j.l, j.v).value;
    });
    const double seconds = threadSeconds() - start;
    return {psnr, 1e9 * seconds / static_cast<double>(judges_.size())};
}

double ModelJudge::psnrOf(const std::function<glm::vec3(const BrdfMeasurement&)>& f) const
{
    const auto shown = [&](const glm::vec3& value, float weight) {
        return glm::clamp(value * (weight / static_cast<float>(peak_)), 0.0f, 1.0f);
    };
    double sum = 0;
    for (const BrdfMeasurement& j : judges_) {
        const glm::vec3 miss = shown(f(j), j.weight) - shown(j.f, j.weight);
        sum += glm::dot(miss, miss);
    }
    return -10 * std::log10(std::max(sum / (3 * static_cast<double>(judges_.size())), 1e-12));
}

std::vector<BrdfMeasurement> ModelJudge::fittedPart() const
{
    const size_t count = std::min(kMostFitted, judges_.size());
    std::vector<BrdfMeasurement> part;
    for (size_t j = 0; j < count; ++j) {
        BrdfMeasurement m = judges_[(2 * j + 1) * judges_.size() / (2 * count)];
        const float brightest = std::max(m.f.x, std::max(m.f.y, m.f.z)) * m.weight;
        m.weight *= std::min(1.0f, static_cast<float>(peak_) / std::max(brightest, 1e-20f));
        part.push_back(m);
    }
    return part;
}

} // namespace nacre
