#include "acquisition/exchange/lobe_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/brdf/brdf_table.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr double kWorthwhile = 0.5; // dB that another parameter has to bring
constexpr double kEnough = 45;      // dB: what is missed is half a percent of the bright end, which nobody sees
constexpr double kNearDecibels = 30, kHalfDecibels = 6.0206;
constexpr int kColourRounds = 3; // until what lobes take from each other is settled
constexpr int kShapeRounds = 5;
constexpr float kFirstRoughness = 0.06f, kRoughnessStep = 1.17f;
constexpr float kMixtures[] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f};
constexpr float kGrazingWeights[] = {0, 0.25f, 0.5f, 0.75f};
constexpr float kIors[] = {1.33f, 1.5f, 1.8f, 2.3f, 3.3f, 6};
constexpr float kSheenRoughnesses[] = {0.15f, 0.3f, 0.5f, 0.75f, 1};
constexpr float kDielectric = 0.04f;       // glTF's reflectance at normal incidence where nothing else is said
constexpr double kQuantileToSigma = 1.645; // nine of ten lie within

struct ColourBounds {
    Eigen::Vector3d low{0, 0, 0}, high{1, 1, 1}; // diffuse, specular, sheen
};

// min sum (w (y - x.a))^2 with bounds on a: of each choice of unknowns at a bound, the others freely. Few unknowns.
struct BoundedFit {
    Eigen::Matrix3d xx = Eigen::Matrix3d::Zero();
    Eigen::Vector3d xy = Eigen::Vector3d::Zero();

    void add(const Eigen::Vector3d& x, double y, double weight)
    {
        xx += weight * x * x.transpose();
        xy += weight * x * y;
    }
    double cost(const Eigen::Vector3d& a) const { return a.dot(xx * a) - 2 * a.dot(xy); }

    Eigen::Vector3d solve(const ColourBounds& bounds) const
    {
        Eigen::Vector3d best = bounds.low;
        double least = std::numeric_limits<double>::max();
        constexpr int kStates = 27;
        for (int code = 0; code < kStates; ++code) {
            const std::array<int, 3> state = {code % 3, code / 3 % 3, code / 9};
            const Eigen::Vector3d a = candidate(bounds, state);
            const bool isWithin =
                ((a - bounds.low).array() >= -1e-12).all() && ((bounds.high - a).array() >= -1e-12).all();
            if (a.allFinite() && isWithin && cost(a) < least) {
                least = cost(a);
                best = a.cwiseMax(bounds.low).cwiseMin(bounds.high);
            }
        }
        return best;
    }

private:
    // state: 0 free, 1 at the lower bound, 2 at the upper one.
    Eigen::Vector3d candidate(const ColourBounds& bounds, const std::array<int, 3>& state) const
    {
        Eigen::Matrix3d matrix = xx;
        Eigen::Vector3d right = xy;
        for (int k = 0; k < 3; ++k) {
            if (state[k] != 0) {
                matrix.row(k).setZero();
                matrix(k, k) = 1;
                right[k] = state[k] == 1 ? bounds.low[k] : bounds.high[k];
            }
        }
        return matrix.fullPivLu().solve(right);
    }
};

struct Trial {
    LobeShape shape;
    LobeColours colours;
    double cost = std::numeric_limits<double>::max();
};

// A variant of a format: which colours may be what.
struct Variant {
    ExchangeFormat format;
    ColourBounds bounds;
    bool hasSheen = false;
};

double costOf(const std::vector<BrdfMeasurement>& measurements, const LobeModel& model, const LobeColours& colours)
{
    double cost = 0;
    for (const BrdfMeasurement& m : measurements) {
        const glm::vec3 miss = m.weight * (model.evaluate(colours, m.n, m.l, m.v) - m.f);
        cost += glm::dot(miss, miss);
    }
    return cost;
}

void solveColours(const std::vector<BrdfMeasurement>& measurements, const LobeModel& model, const ColourBounds& bounds,
                  LobeColours& colours)
{
    std::array<BoundedFit, 3> channels;
    for (const BrdfMeasurement& m : measurements) {
        const LobeTerms t = model.terms(colours, m.n, m.l, m.v);
        const double weight = static_cast<double>(m.weight) * m.weight;
        for (int c = 0; c < 3; ++c) {
            channels[c].add({t.diffuse[c], t.specular[c], t.sheen[c]}, static_cast<double>(m.f[c]) - t.rest[c], weight);
        }
    }
    for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d a = channels[c].solve(bounds);
        colours.diffuse[c] = static_cast<float>(a[0]);
        colours.specular[c] = static_cast<float>(a[1]);
        colours.sheen[c] = static_cast<float>(a[2]);
    }
}

Trial tryShape(const std::vector<BrdfMeasurement>& measurements, const Variant& variant, const LobeShape& shape)
{
    const std::unique_ptr<LobeModel> model = modelOf(variant.format, shape, variant.hasSheen);
    Trial trial{shape, {}};
    for (int round = 0; round < kColourRounds; ++round) {
        solveColours(measurements, *model, variant.bounds, trial.colours);
    }
    trial.cost = costOf(measurements, *model, trial.colours);
    return trial;
}

Trial bestOf(const std::vector<BrdfMeasurement>& measurements, const Variant& variant,
             const std::vector<LobeShape>& shapes, int threads)
{
    std::vector<Trial> trials(shapes.size());
    parallelFor(shapes.size(), 1, threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            trials[i] = tryShape(measurements, variant, shapes[i]);
        }
    });
    return *std::min_element(trials.begin(), trials.end(),
                             [](const Trial& a, const Trial& b) { return a.cost < b.cost; });
}

// A grid over roughness for each of `starts`, refined by halving steps.
Trial search(const std::vector<BrdfMeasurement>& measurements, const Variant& variant,
             const std::vector<LobeShape>& starts, int threads)
{
    std::vector<LobeShape> shapes;
    for (LobeShape shape : starts) {
        for (float r = kFirstRoughness; r < 1.0f; r *= kRoughnessStep) {
            shape.roughness = r;
            shapes.push_back(shape);
        }
        shape.roughness = 1;
        shapes.push_back(shape);
    }
    Trial best = bestOf(measurements, variant, shapes, threads);
    float step = std::sqrt(kRoughnessStep);
    for (int round = 0; round < kShapeRounds; ++round, step = std::sqrt(step)) {
        shapes.clear();
        for (const float factor : {1 / step, 1.0f, step}) {
            for (const float sheen : {1 / step, 1.0f, step}) {
                if (sheen == 1 || variant.hasSheen) {
                    LobeShape shape = best.shape;
                    shape.roughness = std::min(shape.roughness * factor, 1.0f);
                    shape.sheenRoughness = std::min(shape.sheenRoughness * sheen, 1.0f);
                    shapes.push_back(shape);
                }
            }
        }
        best = bestOf(measurements, variant, shapes, threads);
    }
    return best;
}

float rounded(float x)
{
    constexpr float kDigits = 1e4f;
    return std::round(x * kDigits) / kDigits;
}

glm::vec3 rounded(const glm::vec3& v)
{
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

LobeFit fitOf(const ModelJudge& judge, const Variant& variant, Trial trial)
{
    for (float* x : {&trial.shape.roughness, &trial.shape.sheenRoughness}) {
        *x = rounded(*x);
    }
    trial.colours = {rounded(trial.colours.diffuse), rounded(trial.colours.specular), rounded(trial.colours.sheen)};
    LobeFit fit{variant.format, trial.shape, trial.colours};
    const std::unique_ptr<LobeModel> model = modelOf(fit.format, fit.shape, fit.hasSheen());
    fit.psnr = judge.psnrOf([&](const BrdfMeasurement& m) { return model->evaluate(fit.colours, m.n, m.l, m.v); });
    return fit;
}

class Fitter {
public:
    Fitter(const ModelJudge& judge, ExchangeFormat format, float most, int threads)
        : judge_(judge), measurements_(judge.fittedPart()), format_(format), most_(most), threads_(threads)
    {
    }

    LobeFit fit()
    {
        core();
        best_.corePsnr = best_.psnr;
        if (format_ == ExchangeFormat::gltf) {
            extend({{}}, 0, false);
            std::vector<LobeShape> starts;
            for (const float weight : kGrazingWeights) {
                starts.push_back({.specularWeight = weight});
            }
            for (const LobeShape& start : starts) {
                extend({start}, 0, false);
            }
        }
        std::vector<LobeShape> starts;
        for (const float roughness : kSheenRoughnesses) {
            LobeShape shape = best_.shape;
            shape.sheenRoughness = roughness;
            starts.push_back(shape);
        }
        extend(starts, most_, best_.shape.isMetal());
        return best_;
    }

private:
    Variant variantOf(float diffuse, float leastSpecular, float specular, float sheen) const
    {
        return {format_, {{0, leastSpecular, 0}, {diffuse, specular, sheen}}, sheen > 0};
    }

    void core()
    {
        const Variant metal = variantOf(0, 0, most_, 0);
        if (format_ == ExchangeFormat::gltf) {
            consider(variantOf(most_, kDielectric, kDielectric, 0), {{}}, 0);
        } else {
            std::vector<LobeShape> starts;
            for (const float ior : kIors) {
                starts.push_back({.ior = ior});
            }
            consider(variantOf(most_, 0, most_, 0), starts, 0);
        }
        consider(metal, {{.metallic = 1}}, 0);
        if (format_ == ExchangeFormat::gltf) {
            std::vector<LobeShape> mixtures;
            for (const float metallic : kMixtures) {
                mixtures.push_back({.metallic = metallic});
            }
            consider(metal, mixtures, kWorthwhile);
        }
    }

    // More parameters: taken where they pay.
    void extend(const std::vector<LobeShape>& starts, float sheen, bool isMetal)
    {
        if (best_.psnr >= kEnough) {
            return;
        }
        const float weight = isMetal || format_ != ExchangeFormat::gltf ? 1.0f : starts.front().specularWeight;
        consider(variantOf(isMetal ? 0 : most_, 0, most_ * weight, sheen), starts, kWorthwhile);
    }

    void consider(const Variant& variant, const std::vector<LobeShape>& starts, double worthwhile)
    {
        LobeFit fit = fitOf(judge_, variant, search(measurements_, variant, starts, threads_));
        if (fit.psnr > best_.psnr + worthwhile) {
            fit.corePsnr = best_.corePsnr;
            best_ = fit;
        }
    }

    const ModelJudge& judge_;
    std::vector<BrdfMeasurement> measurements_;
    ExchangeFormat format_;
    float most_;
    int threads_;
    LobeFit best_{.psnr = -std::numeric_limits<double>::max()};
};

} // namespace

std::unique_ptr<LobeModel> modelOf(ExchangeFormat format, const LobeShape& shape, bool hasSheen)
{
    return format == ExchangeFormat::gltf ? gltfModel(shape, hasSheen) : standardSurfaceModel(shape, hasSheen);
}

LobeFitScale fitScale(const ModelJudge& judge)
{
    const BrdfTable& table = judge.table();
    LobeFitScale scale;
    scale.black = judge.psnrOf([](const BrdfMeasurement&) { return glm::vec3(0); });
    scale.expected = std::numeric_limits<double>::infinity();
    if (!table.error.empty()) {
        scale.expected = judge.psnrOf([&](const BrdfMeasurement& m) {
            const float error = sampleError(table, unitFromDirections(table.domain, m.n, m.l, m.v));
            return m.f * (1 - std::min(error / static_cast<float>(kQuantileToSigma), 1.0f));
        });
    }
    return scale;
}

bool isFar(const LobeFit& fit, const LobeFitScale& scale)
{
    return fit.psnr < std::min(kNearDecibels, scale.expected);
}

bool isNothing(const LobeFit& fit, const LobeFitScale& scale)
{
    return !(fit.psnr >= scale.black + kHalfDecibels);
}

LobeFit fitLobes(const ModelJudge& judge, ExchangeFormat format, float most, int threads)
{
    return Fitter(judge, format, most, threads).fit();
}

} // namespace nacre
