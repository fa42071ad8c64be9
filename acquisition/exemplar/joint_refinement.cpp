#include "acquisition/exemplar/joint_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/reflectance_slopes.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Enough that a reflectance of 400 numbers is known better than its form is true.
constexpr size_t kMostRefined = 600;
constexpr size_t kRefinedPerTask = 64;
constexpr int kMostRefinements = 10;
constexpr double kLeastGainOfStep = 1e-3;
constexpr double kFirstDamping = 1e-3, kMostDamping = 1e4, kDampingUp = 10, kDampingDown = 0.2;
// Residuals have weights up to so many times the truncation, as polishing has them.
constexpr float kWeightLimit = 1.5f;
// A step turns no normal by more than three degrees, and no albedo by more than a half.
constexpr double kMostTurn = 0.05, kMostScaling = 0.5;
constexpr float kLeastZ = 0.02f;
// Curvature of T along thetaH, of u and v, slope of T along thetaD: what a few observations of a texel outweigh.
constexpr double kLobePrior = 0.5, kShadePrior = 150;
// Less of them where w is known as well, whose size, curvature by n.l and n.v, and slope by thetaD weigh so much.
constexpr double kEaseOfCoupling = 0.3, kCouplingPrior = 1;
constexpr double kAnchorPrior = 1e3, kStayPrior = 1e-6;
constexpr float kAsinhUnit = 0.1f; // of the median albedo

struct Problem {
    const PixelLattice& lattice;
    std::vector<LightPlace> lights;
    const Reflectance& like;
    float unit;
    float limit; // of residuals
    int threads;
};

struct Estimate {
    Eigen::VectorXd unknowns;
    std::vector<PixelGuess> guesses;
};

// r^2 / 2 - |r|^3 / 3c up to the limit c: its derivative is r (1 - |r| / c), a weight that falls to zero.
double lossOf(float residual, float limit)
{
    const double r = std::min(std::abs(residual), limit);
    return r * r / 2 - r * r * r / (3 * limit);
}

// Calls the function with each row of the prior: its weight, its value, whose square is penalised, and the factors of
// the unknowns in it.
template <class Row> void eachPriorRow(const Reflectance& like, const Eigen::VectorXd& unknowns, const Row& visit)
{
    const double ease = like.coupling.empty() ? 1 : kEaseOfCoupling;
    using Terms = std::initializer_list<std::pair<int, double>>;
    const auto row = [&](double weight, Terms terms) {
        double value = 0;
        for (const auto& [k, factor] : terms) {
            value += factor * unknowns[k];
        }
        visit(weight, value, terms);
    };
    for (int k = 0; k < kLobeUnknowns; ++k) {
        const int half = k / kDifferenceBins;
        if (half > 0 && half + 1 < kHalfBins) {
            row(ease * kLobePrior, Terms{{k - kDifferenceBins, 1}, {k, -2}, {k + kDifferenceBins, 1}});
        }
        if (k % kDifferenceBins + 1 < kDifferenceBins) {
            row(ease * kLobePrior, Terms{{k, 1}, {k + 1, -1}});
        }
        row(kStayPrior, Terms{{k, 1}});
    }
    for (const int first : {kShadeUnknowns, kSlantUnknowns}) {
        for (int k = first + 1; k + 1 < first + kShadeKnots; ++k) {
            row(ease * kShadePrior, Terms{{k - 1, 1}, {k, -2}, {k + 1, 1}});
        }
        row(kAnchorPrior, Terms{{first + 12, 0.2}, {first + 13, 0.8}}); // u = 0 at n.l = 0.8, v at n.v
    }
    constexpr int nextD = 1, nextV = kCouplingDifferences, nextL = kCouplingKnots * nextV;
    for (int k = 0; k < static_cast<int>(like.coupling.size()); ++k) {
        const int w = kCouplingUnknowns + k, v = k / nextV % kCouplingKnots, l = k / nextL;
        row(kCouplingPrior, Terms{{w, 1}});
        if (k % kCouplingDifferences + 1 < kCouplingDifferences) {
            row(kCouplingPrior, Terms{{w, 1}, {w + nextD, -1}});
        }
        if (v > 0 && v + 1 < kCouplingKnots) {
            row(kCouplingPrior, Terms{{w - nextV, 1}, {w, -2}, {w + nextV, 1}});
        }
        if (l > 0 && l + 1 < kCouplingKnots) {
            row(kCouplingPrior, Terms{{w - nextL, 1}, {w, -2}, {w + nextL, 1}});
        }
    }
}

double priorCost(const Reflectance& like, const Eigen::VectorXd& unknowns)
{
    double cost = 0;
    eachPriorRow(like, unknowns, [&](double weight, double value, auto) { cost += weight * value * value / 2; });
    return cost;
}

double costOf(const Problem& problem, const Estimate& estimate)
{
    const SlopedReflectance sloped = reflectanceOf(estimate.unknowns, problem.unit, problem.like);
    std::vector<double> costs((estimate.guesses.size() + kRefinedPerTask - 1) / kRefinedPerTask);
    parallelFor(estimate.guesses.size(), kRefinedPerTask, problem.threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            const PixelGuess& guess = estimate.guesses[p];
            for (size_t i = 0; i < problem.lights.size(); ++i) {
                const float observed = problem.lattice.rootsOf(guess.pixel)[i];
                if (!isClipped(observed)) {
                    const float root =
                        rootSlopes(sloped, guess, {}, problem.lattice.bright[guess.pixel], problem.lights[i]).root;
                    costs[first / kRefinedPerTask] += lossOf(observed - root, problem.limit);
                }
            }
        }
    });
    return std::accumulate(costs.begin(), costs.end(), priorCost(problem.like, estimate.unknowns));
}

// The normal equations of the unknowns that all pixels share. Of the matrix the lower triangle is told.
struct SharedEquations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
};

// A pixel's own ones, and how they hang together with those.
struct PixelEquations {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, Eigen::Dynamic> cross;
};

PixelEquations equationsOf(const Problem& problem, const SlopedReflectance& sloped, const PixelGuess& guess,
                           SharedEquations& shared)
{
    PixelEquations own;
    own.cross.setZero(3, shared.right.size());
    const NormalBasis basis = basisOf(guess.normal);
    for (size_t i = 0; i < problem.lights.size(); ++i) {
        const float observed = problem.lattice.rootsOf(guess.pixel)[i];
        const RootSlopes slopes =
            rootSlopes(sloped, guess, basis, problem.lattice.bright[guess.pixel], problem.lights[i]);
        const double residual = observed - slopes.root, weight = 1 - std::abs(residual) / problem.limit;
        if (!(weight > 0)) { // or clipped
            continue;
        }
        const Eigen::Vector3d byPixel(slopes.byPixel[0], slopes.byPixel[1], slopes.byPixel[2]);
        own.matrix += weight * byPixel * byPixel.transpose();
        own.right += weight * residual * byPixel;
        for (int a = 0; a < slopes.count; ++a) {
            const double weighted = weight * slopes.byUnknown[a];
            own.cross.col(slopes.unknowns[a]) += weighted * byPixel;
            shared.right[slopes.unknowns[a]] += weighted * residual;
            for (int b = 0; b < slopes.count; ++b) {
                shared.matrix(slopes.unknowns[a], slopes.unknowns[b]) += weighted * slopes.byUnknown[b];
            }
        }
    }
    return own;
}

// All pixels' equations, each pixel's unknowns eliminated from the shared ones. What is taken from the matrix for that
// is summed in floats: it steers steps, where they end is the right side's.
SharedEquations eliminated(const Problem& problem, const Estimate& estimate, double damping,
                           std::vector<PixelEquations>& pixels)
{
    const SlopedReflectance sloped = reflectanceOf(estimate.unknowns, problem.unit, problem.like);
    const size_t count = estimate.guesses.size();
    const Eigen::Index unknowns = estimate.unknowns.size();
    pixels.resize(count);
    std::array<SharedEquations, 2> halves; // two, whatever the number of threads
    parallelFor(halves.size(), 1, problem.threads, [&](size_t half, size_t) {
        SharedEquations& shared = halves[half];
        shared.matrix.setZero(unknowns, unknowns);
        shared.right.setZero(unknowns);
        for (size_t first = half * kRefinedPerTask; first < count; first += halves.size() * kRefinedPerTask) {
            const size_t last = std::min(count, first + kRefinedPerTask);
            Eigen::MatrixXf stacked(3 * (last - first), unknowns);
            for (size_t p = first; p < last; ++p) {
                PixelEquations& own = pixels[p];
                own = equationsOf(problem, sloped, estimate.guesses[p], shared);
                own.matrix.diagonal() *= 1 + damping;
                own.matrix.diagonal().array() += kStayPrior;
                const Eigen::LLT<Eigen::Matrix3d> factor(own.matrix);
                stacked.middleRows(static_cast<Eigen::Index>(3 * (p - first)), 3) =
                    factor.matrixL().solve(own.cross).cast<float>();
                shared.right -= own.cross.transpose() * factor.solve(own.right);
            }
            Eigen::MatrixXf taken = Eigen::MatrixXf::Zero(unknowns, unknowns);
            taken.selfadjointView<Eigen::Lower>().rankUpdate(stacked.transpose());
            shared.matrix -= taken.cast<double>();
        }
    });
    halves[0].matrix += halves[1].matrix;
    halves[0].right += halves[1].right;
    return std::move(halves[0]);
}

void addPrior(const Reflectance& like, const Eigen::VectorXd& unknowns, SharedEquations& shared)
{
    eachPriorRow(like, unknowns, [&](double weight, double value, auto terms) {
        for (const auto& [a, p] : terms) {
            shared.right[a] -= weight * p * value;
            for (const auto& [b, q] : terms) {
                shared.matrix(a, b) += weight * p * q;
            }
        }
    });
}

PixelGuess moved(const PixelGuess& guess, const Eigen::Vector3d& change)
{
    const NormalBasis basis = basisOf(guess.normal);
    const double share = std::min(1.0, kMostTurn / std::max(std::hypot(change[0], change[1]), 1e-12));
    glm::vec3 normal = glm::normalize(guess.normal + static_cast<float>(share * change[0]) * basis.across +
                                      static_cast<float>(share * change[1]) * basis.along);
    normal.z = std::max(normal.z, kLeastZ);
    return {guess.pixel, glm::normalize(normal),
            guess.logScale + static_cast<float>(std::clamp(change[2], -kMostScaling, kMostScaling))};
}

Estimate stepFrom(const Problem& problem, const Estimate& estimate, double damping)
{
    std::vector<PixelEquations> pixels;
    SharedEquations shared = eliminated(problem, estimate, damping, pixels);
    addPrior(problem.like, estimate.unknowns, shared);
    shared.matrix.diagonal() *= 1 + damping;
    Eigen::VectorXd change = shared.matrix.selfadjointView<Eigen::Lower>().ldlt().solve(shared.right);
    change /= std::max(1.0, change.cwiseAbs().maxCoeff());
    Estimate next{estimate.unknowns + change, {}};
    for (size_t p = 0; p < pixels.size(); ++p) {
        next.guesses.push_back(
            moved(estimate.guesses[p], pixels[p].matrix.llt().solve(pixels[p].right - pixels[p].cross * change)));
    }
    return next;
}

// From the matches of some pixels; what they and the reflectance explain best.
Estimate refined(const Problem& problem, Estimate estimate)
{
    double cost = costOf(problem, estimate), damping = kFirstDamping;
    for (int k = 0; k < kMostRefinements && damping < kMostDamping; ++k) {
        Estimate next = stepFrom(problem, estimate, damping);
        const double nextCost = costOf(problem, next);
        if (!(nextCost < cost)) {
            damping *= kDampingUp;
            continue;
        }
        const bool isLittle = nextCost > (1 - kLeastGainOfStep) * cost;
        estimate = std::move(next);
        cost = nextCost;
        damping *= kDampingDown;
        if (isLittle) {
            break;
        }
    }
    return estimate;
}

} // namespace

void refineJointly(const PixelLattice& lattice, int threads, MatchModel& model, std::vector<BallMatch>& matches)
{
    const BallGrid& grid = *model.ball.grid;
    Estimate estimate;
    std::vector<float> albedos, scalings;
    for (const size_t p : spreadPixels(matches.size(), kMostRefined)) {
        if (matches[p].row >= 0 && matches[p].scale > 0) {
            estimate.guesses.push_back({p, normalOfBallTexel(matches[p].texel, grid.size), std::log(matches[p].scale)});
            albedos.push_back(matches[p].scale * lattice.bright[p]);
        }
    }
    if (estimate.guesses.empty()) {
        return;
    }
    const Reflectance like = model.reflectance;
    const Problem problem{
        lattice, lightPlaces(grid), like, kAsinhUnit * quantile(albedos, 0.5), kWeightLimit * model.truncation,
        threads};
    estimate.unknowns = unknownsOf(like, problem.unit);
    estimate = refined(problem, std::move(estimate));
    model.reflectance = reflectanceOf(estimate.unknowns, problem.unit, like).reflectance;
    for (const PixelGuess& guess : estimate.guesses) {
        BallMatch& match = matches[guess.pixel];
        scalings.push_back(std::exp(guess.logScale) / match.scale);
        match.texel = ballTexelOf(guess.normal, grid.size);
        match.scale *= scalings.back();
    }
    if (!like.oneAlbedo) { // T and the albedos share a factor, which may have moved
        const float scaling = quantile(scalings, 0.5);
        model.albedos.low *= scaling;
        model.albedos.high *= scaling;
    }
    model.ball = makeReflectanceBall(grid, model.reflectance, threads);
    forgetCosts(matches);
}

} // namespace nacre
