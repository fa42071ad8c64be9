#include "acquisition/exemplar/exemplar_estimator.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kJudgedPerTask = 512;
// A match that costs so many times the object's median is in doubt; consensus takes its place where Lambert's law costs
// so much less.
constexpr float kDoubtful = 1.5f;
constexpr float kLambertShare = 0.8f;

// From the scatter of the used residuals through the lights that are left, as for Lambertian pixels.
float confidenceOf(std::span<const float> observed, std::span<const float> predicted, std::span<const Verdict> verdicts,
                   const std::vector<Light>& lights)
{
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    double squares = 0, brightness = 0;
    size_t used = 0;
    for (size_t i = 0; i < observed.size(); ++i) {
        if (verdicts[i] == Verdict::used) {
            const Eigen::Vector3d l(lights[i].direction.x, lights[i].direction.y, lights[i].direction.z);
            gram += l * l.transpose();
            squares += (observed[i] - predicted[i]) * (observed[i] - predicted[i]);
            brightness += observed[i];
            ++used;
        }
    }
    if (used < 3 || !(gram.determinant() > 0)) {
        return 0;
    }
    const double scatter = std::sqrt(squares / std::max<double>(1, static_cast<double>(used) - 3));
    return nacre::confidenceOf(normalUncertainty(static_cast<float>(scatter),
                                                 static_cast<float>(brightness / static_cast<double>(used)),
                                                 static_cast<float>(gram.inverse().trace())));
}

struct ExemplarSetup {
    std::vector<Light> lights;
    ExemplarModel model;
    MatchModel lambert; // on the model's ball
    NormalEstimator consensus;
    float doubtfulCost; // of a match
    int threads;
};

ExemplarSetup makeSetup(ExemplarModel model, const std::vector<Light>& lights, const NormalOptions& options)
{
    MatchModel lambert;
    lambert.truncation = model.match.truncation;
    lambert.ball = makeReflectanceBall(*model.grid, lambert.reflectance, options.threads);
    const float doubtful = kDoubtful * model.typicalCost;
    return {lights,   std::move(model), std::move(lambert), makeConsensusEstimator(lights, options),
            doubtful, options.threads};
}

NormalBlock judgedBlock(const ExemplarSetup& setup, const PixelLattice& pixels, const std::vector<BallMatch>& matches)
{
    const size_t n = pixels.lightCount;
    NormalBlock block{std::vector<PixelNormal>(matches.size()), std::vector<Verdict>(matches.size() * n)};
    parallelFor(matches.size(), kJudgedPerTask, setup.threads, [&](size_t first, size_t last) {
        std::vector<float> predicted(n);
        for (size_t p = first; p < last; ++p) {
            const std::span<const float> observed = pixels.intensities.ofPixel(p);
            const auto verdicts = std::span(block.verdicts).subspan(p * n, n);
            predictMatch(setup.model.match, matches[p], pixels.bright[p], predicted.data());
            const glm::vec3 normal = normalOfBallTexel(matches[p].texel, setup.model.grid->size);
            for (size_t i = 0; i < n; ++i) {
                // What surroundings alone light lies in shadow.
                predicted[i] = glm::dot(normal, setup.model.grid->directions[i]) > 0 ? predicted[i] : 0;
            }
            judge(observed, predicted, verdicts);
            if (matches[p].row < 0 || !(matches[p].scale > 0)) {
                continue;
            }
            const auto used = std::count(verdicts.begin(), verdicts.end(), Verdict::used);
            // A BRDF is reciprocal: where e^u(n.l) is in it, e^u(n.v) is, too, and not in the albedo.
            const Reflectance& reflectance = setup.model.match.reflectance;
            const float albedo = reflectance.oneAlbedo
                                     ? *reflectance.oneAlbedo
                                     : matches[p].scale * pixels.bright[p] / std::exp(reflectance.shadeAt(normal.z));
            block.pixels[p] = {normal, albedo, confidenceOf(observed, predicted, verdicts, setup.lights),
                               static_cast<uint16_t>(used)};
        }
    });
    return block;
}

// Pixels that the object's reflectance explains badly, such as those of another material, are taken from consensus
// where Lambert's law explains them better.
void preferConsensus(const ExemplarSetup& setup, const PixelLattice& pixels, const std::vector<BallMatch>& matches,
                     NormalBlock& block)
{
    std::vector<size_t> doubtful;
    for (size_t p = 0; p < matches.size(); ++p) {
        if (matches[p].cost > setup.doubtfulCost) {
            doubtful.push_back(p);
        }
    }
    const NormalBlock other = setup.consensus(selectPixels(pixels.intensities, doubtful));
    const size_t n = pixels.lightCount;
    for (size_t j = 0; j < doubtful.size(); ++j) {
        const size_t p = doubtful[j];
        const glm::vec2 texel = ballTexelOf(other.pixels[j].normal, setup.model.grid->size);
        if (other.pixels[j].confidence > 0 &&
            matchAtTexel(setup.lambert, pixels, p, texel, 1).cost < kLambertShare * matches[p].cost) {
            block.pixels[p] = other.pixels[j];
            std::copy_n(other.verdicts.begin() + static_cast<std::ptrdiff_t>(j * n), n,
                        block.verdicts.begin() + static_cast<std::ptrdiff_t>(p * n));
        }
    }
}

} // namespace

NormalEstimator makeExemplarEstimator(ExemplarModel model, const std::vector<Light>& lights,
                                      const NormalOptions& options)
{
    const auto setup = std::make_shared<const ExemplarSetup>(makeSetup(std::move(model), lights, options));
    return [setup](const Intensities& intensities) {
        const PixelLattice pixels = makePixelLattice(intensities, setup->threads);
        const std::vector<BallMatch> matches = matchPixels(setup->model, pixels, setup->threads);
        NormalBlock block = judgedBlock(*setup, pixels, matches);
        preferConsensus(*setup, pixels, matches, block);
        return block;
    };
}

NormalEstimator makeExemplarEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                      const NormalOptions& options, std::vector<Finding>& findings)
{
    std::optional<Jury> jury;
    if (const std::optional<LightSplit> split = splitLights(lights)) {
        jury = makeJury(sample, *split, options.threads);
    }
    return makeExemplarEstimator(makeExemplarModel(sample, lights, options, jury ? &*jury : nullptr, findings), lights,
                                 options);
}

} // namespace nacre
