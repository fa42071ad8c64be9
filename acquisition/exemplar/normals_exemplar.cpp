#include "acquisition/exemplar/normals_exemplar.h"

#include <memory>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/exemplar_model.h"
#include "acquisition/exemplar/object_exemplar.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kExemplarPixelsPerTask = 512;

std::vector<glm::vec3> startsOf(const NormalBlock& consensus)
{
    std::vector<glm::vec3> starts;
    for (const PixelNormal& pixel : consensus.pixels) {
        starts.push_back(pixel.albedo > 0 ? pixel.normal : glm::vec3(0, 0, 1));
    }
    return starts;
}

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
    std::vector<float> weights;
    NormalEstimator consensus;
    ExemplarModel model;
    int threads;
};

void fillPixels(const ExemplarSetup& setup, const Intensities& intensities, const ExemplarResult& result,
                NormalBlock& block)
{
    const size_t n = intensities.lightCount;
    const Exemplar& last =
        setup.model.reestimated.empty() ? setup.model.exemplars.front() : setup.model.reestimated.back();
    parallelFor(block.pixels.size(), kExemplarPixelsPerTask, setup.threads, [&](size_t first, size_t end) {
        std::vector<float> predicted(last.fine.stride);
        for (size_t p = first; p < end; ++p) {
            last.fine.mixColumns(result.normals[p], predicted.data());
            std::transform(predicted.begin(), predicted.end(), predicted.begin(),
                           [&](float v) { return v * result.scales[p]; });
            const auto verdicts = std::span<const Verdict>(block.verdicts).subspan(p * n, n);
            const bool found = result.scales[p] > 0;
            const float confidence =
                found ? confidenceOf(intensities.ofPixel(p), std::span(predicted).first(n), verdicts, setup.lights)
                      : 0.0f;
            const auto used = std::count(verdicts.begin(), verdicts.end(), Verdict::used);
            block.pixels[p] = {found ? result.normals[p] : glm::vec3(0), result.scales[p], confidence,
                               static_cast<uint16_t>(used)};
        }
    });
}

} // namespace

NormalEstimator makeExemplarEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                      const NormalOptions& options, std::vector<Finding>& findings)
{
    const auto setup = std::make_shared<ExemplarSetup>();
    setup->lights = lights;
    setup->weights = allLights(lights.size());
    setup->threads = options.threads;
    setup->consensus = makeConsensusEstimator(lights, options);
    setup->model = makeExemplarModel(sample, startsOf(setup->consensus(sample)), lights, options, findings);
    return [setup](const Intensities& intensities) {
        const std::vector<glm::vec3> starts = startsOf(setup->consensus(intensities));
        const ExemplarResult result = matchBlock(setup->model, intensities, starts, setup->weights, setup->threads);
        NormalBlock block{std::vector<PixelNormal>(intensities.pixelCount()),
                          judgeByExemplar(lastExemplar(setup->model), intensities, result, setup->threads)};
        fillPixels(*setup, intensities, result, block);
        return block;
    };
}

} // namespace nacre
