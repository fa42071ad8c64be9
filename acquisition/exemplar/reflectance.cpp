#include "acquisition/exemplar/reflectance.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "acquisition/normals/intensities.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kBallRowsPerTask = 128;
constexpr float kShadeAnchor = 0.8f;
constexpr float kLeastPowerCosine = 0.03f;

// T over thetaH for each light, whose thetaD is fixed.
std::vector<float> lightProfiles(const BallGrid& grid, const Reflectance& reflectance)
{
    std::vector<float> profiles;
    profiles.reserve(grid.lightCount * kHalfBins);
    for (const LightPlace& light : lightPlaces(grid)) {
        for (int half = 0; half < kHalfBins; ++half) {
            const float* lobe = &reflectance.lobe[static_cast<size_t>(half) * kDifferenceBins + light.difference];
            profiles.push_back(lobe[0] * (1 - light.nextShare) + lobe[1] * light.nextShare);
        }
    }
    return profiles;
}

Reflectance tabulated(const BrdfModel& model, float largestThetaD)
{
    Reflectance result;
    for (int half = 0; half < kHalfBins; ++half) {
        for (int difference = 0; difference < kDifferenceBins; ++difference) {
            const float thetaH = thetaHOfBin(half),
                        thetaD = (static_cast<float>(difference) + 0.5f) / kDifferenceBins * largestThetaD;
            // phiD = 90 degrees: light and view stand beside the plane of n and h, both above the horizon longest.
            const glm::vec3 h(std::sin(thetaH), 0, std::cos(thetaH)), aside(0, std::sin(thetaD), 0);
            result.lobe[static_cast<size_t>(half) * kDifferenceBins + difference] =
                static_cast<float>(kPi) *
                greyOf(evaluate(model, {0, 0, 1}, std::cos(thetaD) * h + aside, std::cos(thetaD) * h - aside));
        }
    }
    return result;
}

// ABC lobes D = A / (1 + B (1 - cos thetaH))^C (Loew et al. 2012): B sets the width (1/sqrt(B) radians), C the tail.
constexpr float kLobeWidths[] = {20, 150, 1000, 7000, 50000};
constexpr float kLobeTails[] = {0.6f, 1.0f, 1.6f, 2.6f};
// The lobe's peak over the diffuse part; 0: no diffuse part, as in metals.
constexpr float kLobePeaks[] = {0.3f, 1.5f, 6, 25, 100, 0};
constexpr float kLobeIor = 1.6f;

NamedBrdf builtInLobe(float width, float tail, float peak)
{
    const float f0 = (kLobeIor - 1) * (kLobeIor - 1) / ((kLobeIor + 1) * (kLobeIor + 1));
    AbcModel model;
    model.kD = glm::vec3(peak > 0 ? 1.0f : 0.0f);
    model.A = glm::vec3((peak > 0 ? peak : 1.0f) / f0);
    model.B = width;
    model.C = tail;
    model.ior = kLobeIor;
    return {fmt::format("built-in lobe of B {:g}, C {:g}, {}", width, tail,
                        peak > 0 ? fmt::format("{:g} x diffuse", peak) : "no diffuse part"),
            model};
}

std::string withoutNumber(std::string name)
{
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back()))) {
        name.pop_back();
    }
    return name;
}

void addFits(const std::string& family, const std::vector<NamedBrdf>& fits, const std::vector<std::string>& excluded,
             std::vector<NamedBrdf>& dictionary)
{
    for (const NamedBrdf& fit : fits) {
        const bool out = std::any_of(excluded.begin(), excluded.end(), [&](const std::string& name) {
            return withoutNumber(name) == withoutNumber(fit.name);
        });
        if (!out) {
            dictionary.push_back({family + ":" + fit.name, fit.model});
        }
    }
}

float atCosine(const std::array<float, kShadeKnots>& knots, float cosine)
{
    const Between at = between(cosine * (kShadeKnots - 1), kShadeKnots);
    return knots[at.knot] * (1 - at.share) + knots[at.knot + 1] * at.share;
}

} // namespace

float Reflectance::shadeAt(float cosine) const
{
    return atCosine(shade, cosine);
}

float Reflectance::slantAt(float cosine) const
{
    return atCosine(slant, cosine);
}

float Reflectance::couplingAt(float nDotL, float nDotV, const LightPlace& light) const
{
    float sum = 0;
    if (!coupling.empty()) {
        const CouplingPlace at = couplingPlace(nDotL, nDotV, light);
        for (int k = 0; k < 8; ++k) {
            sum += at.weights[k] * coupling[at.knots[k]];
        }
    }
    return sum;
}

CouplingPlace couplingPlace(float nDotL, float nDotV, const LightPlace& light)
{
    const float difference = (static_cast<float>(light.difference) + light.nextShare) / (kDifferenceBins - 1);
    const Between l = between(nDotL * (kCouplingKnots - 1), kCouplingKnots),
                  v = between(nDotV * (kCouplingKnots - 1), kCouplingKnots),
                  d = between(difference * (kCouplingDifferences - 1), kCouplingDifferences);
    CouplingPlace place;
    for (int k = 0; k < 8; ++k) {
        const int nextL = k & 1, nextV = k >> 1 & 1, nextD = k >> 2;
        const float ofL = nextL ? l.share : 1 - l.share, ofV = nextV ? v.share : 1 - v.share,
                    ofD = nextD ? d.share : 1 - d.share;
        place.knots[k] = ((l.knot + nextL) * kCouplingKnots + v.knot + nextV) * kCouplingDifferences + d.knot + nextD;
        place.weights[k] = ofL * ofV * ofD;
        place.slopesByL[k] = (nextL ? 1 : -1) * (kCouplingKnots - 1) * ofV * ofD;
        place.slopesByV[k] = (nextV ? 1 : -1) * (kCouplingKnots - 1) * ofL * ofD;
    }
    return place;
}

std::array<float, kShadeKnots> shadeOfPower(float exponent)
{
    std::array<float, kShadeKnots> shade{};
    for (int k = 0; k < kShadeKnots; ++k) {
        const float cosine = std::max(static_cast<float>(k) / (kShadeKnots - 1), kLeastPowerCosine);
        shade[k] = (exponent - 1) * std::log(cosine / kShadeAnchor);
    }
    return shade;
}

ReflectanceBall makeReflectanceBall(const BallGrid& grid, const Reflectance& reflectance, int threads)
{
    return makeReflectanceBall(grid, reflectance, shadesOf(grid, reflectance, threads), threads);
}

std::vector<float> shadesOf(const BallGrid& grid, const Reflectance& reflectance, int threads)
{
    std::vector<float> shades(grid.cosines.size(), 1.0f);
    const auto& shade = reflectance.shade;
    if (std::all_of(shade.begin(), shade.end(), [](float u) { return u == 0; })) {
        return shades;
    }
    parallelFor(grid.normals.size(), kBallRowsPerTask, threads, [&](size_t first, size_t last) {
        for (size_t at = first * grid.stride; at < last * grid.stride; ++at) {
            shades[at] = grid.cosines[at] > 0 ? std::exp(reflectance.shadeAt(grid.cosines[at])) : 1.0f;
        }
    });
    return shades;
}

ReflectanceBall makeReflectanceBall(const BallGrid& grid, const Reflectance& reflectance,
                                    const std::vector<float>& shades, int threads)
{
    ReflectanceBall ball{&grid, reflectance.additive, std::vector<float>(grid.cosines.size(), 0.0f), {}, {}, {}, {}};
    (reflectance.additive ? ball.gloss : ball.roots).resize(grid.cosines.size(), 0.0f);
    ball.bright.resize(grid.normals.size());
    ball.middling.resize(grid.normals.size());
    const std::vector<float> profiles = lightProfiles(grid, reflectance);
    const std::vector<LightPlace> lights = lightPlaces(grid);
    parallelFor(grid.normals.size(), kBallRowsPerTask, threads, [&](size_t first, size_t last) {
        std::vector<float> values;
        for (size_t row = first; row < last; ++row) {
            const float nDotV = grid.normals[row].z, slanted = std::exp(reflectance.slantAt(nDotV)),
                        bounced = slanted * reflectance.bounced;
            for (size_t i = 0; i < grid.lightCount; ++i) {
                const size_t at = row * grid.stride + i;
                const float cosine = grid.cosines[at];
                ball.diffuse[at] = bounced;
                if (!reflectance.additive) {
                    ball.roots[at] = std::sqrt(bounced);
                }
                if (cosine <= 0) {
                    continue;
                }
                const int bin = static_cast<int>(grid.halfBins[at]);
                const float share = grid.halfBins[at] - static_cast<float>(bin);
                const float* profile = &profiles[i * kHalfBins + bin];
                const float lobe = (profile[0] * (1 - share) + profile[1] * share) * cosine;
                const float coupled = std::exp(reflectance.couplingAt(cosine, nDotV, lights[i]));
                ball.diffuse[at] += slanted * coupled * shades[at] * (reflectance.additive ? cosine : lobe);
                if (reflectance.additive) {
                    ball.gloss[at] = lobe;
                } else {
                    ball.roots[at] = std::sqrt(ball.diffuse[at]);
                }
            }
            if (reflectance.additive) {
                continue;
            }
            const std::span<const float> column(&ball.diffuse[row * grid.stride], grid.lightCount);
            ball.bright[row] = brightLevel(column);
            values.assign(column.begin(), column.end());
            ball.middling[row] = quantile(values, kMiddling);
        }
    });
    return ball;
}

std::vector<NamedReflectance> reflectanceDictionary(const std::filesystem::path& fitsFolder,
                                                    const std::vector<std::string>& excluded, float largestThetaD)
{
    std::vector<NamedBrdf> models;
    for (const float width : kLobeWidths) {
        for (const float tail : kLobeTails) {
            for (const float peak : kLobePeaks) {
                models.push_back(builtInLobe(width, tail, peak));
            }
        }
    }
    if (!fitsFolder.empty()) {
        addFits("merl-abc", loadAbcFits(fitsFolder / "merl_abc_params.csv"), excluded, models);
        addFits("merl-sgd", loadSgdFits(fitsFolder / "merl_sgd_params.csv"), excluded, models);
    }
    std::vector<NamedReflectance> dictionary{{"Lambert", {}}};
    for (const NamedBrdf& named : models) {
        dictionary.push_back({named.name, tabulated(named.model, largestThetaD)});
    }
    return dictionary;
}

} // namespace nacre
