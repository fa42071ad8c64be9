#include "engine/rti/rti_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

std::vector<double> biquadratic(double x, double y)
{
    return {1, x, y, x * x, x * y, y * y};
}

constexpr size_t kPixelsAtOnce = 4096;
// Few, since each is a picture to render; a prime, so that the spiral does not fall into step with the fitted one.
constexpr int kCheckLights = 17;
constexpr double kCheckTurn = 0.5; // radians

using Matrix = std::vector<std::vector<double>>;

std::vector<glm::vec3> spiral(int count, double turn)
{
    const double goldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<glm::vec3> lights;
    for (int i = 0; i < count; ++i) {
        const double radius = std::cos(kLowestRtiLight) * std::sqrt((i + 0.5) / count);
        const double azimuth = turn + i * goldenAngle;
        lights.emplace_back(radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - radius * radius));
    }
    return lights;
}

// Gauss-Jordan elimination of the left square of [left | right], with row pivots; what stands right of it is then
// left^-1 right.
void eliminate(Matrix& rows)
{
    for (size_t k = 0; k < rows.size(); ++k) {
        const auto pivot =
            std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                             [k](const auto& a, const auto& b) { return std::abs(a[k]) < std::abs(b[k]); });
        std::swap(rows[k], *pivot);
        const double scale = 1 / rows[k][k];
        for (double& value : rows[k]) {
            value *= scale;
        }
        for (size_t i = 0; i < rows.size(); ++i) {
            const double factor = rows[i][k];
            for (size_t j = 0; i != k && j < rows[i].size(); ++j) {
                rows[i][j] -= factor * rows[k][j];
            }
        }
    }
}

// (B^T B)^-1 B^T, a row a term and a column a light, B holding the lights' weights.
Matrix pseudoInverse(RtiBasis basis, std::span<const glm::vec3> lights)
{
    const size_t terms = rtiTermCount(basis);
    Matrix rows(terms, std::vector<double>(terms + lights.size(), 0.0));
    for (size_t light = 0; light < lights.size(); ++light) {
        const std::vector<double> weights = rtiWeights(basis, lights[light]);
        for (size_t i = 0; i < terms; ++i) {
            for (size_t j = 0; j < terms; ++j) {
                rows[i][j] += weights[i] * weights[j];
            }
            rows[i][terms + light] = weights[i];
        }
    }
    eliminate(rows);
    for (std::vector<double>& row : rows) {
        row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(terms));
    }
    return rows;
}

void addScaled(Image& sum, const Image& picture, float factor, int threads)
{
    parallelFor(sum.values.size(), 3 * kPixelsAtOnce, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            sum.values[i] += factor * picture.values[i];
        }
    });
}

} // namespace

// Shifted Legendre functions of 2 cos(theta) - 1 times cos or sin of m phi; even m with the sign of `relight`.
std::vector<double> hemisphericalHarmonics(const glm::vec3& light, int order)
{
    using std::numbers::pi;
    const double z = std::clamp<double>(light.z, -1, 1);
    const double theta = std::min(std::acos(z), pi / 2 - kLowestRtiLight);
    const double argument = 2 * std::cos(theta) - 1, phi = std::atan2(double{light.y}, double{light.x});
    std::vector<double> values;
    for (int l = 0; l <= order; ++l) {
        for (int m = -l; m <= l; ++m) {
            const int k = std::abs(m);
            const double square = (2 * l + 1) * std::tgamma(l - k + 1) / (2 * pi * std::tgamma(l + k + 1));
            const double legendre = std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(k), argument);
            const double azimuth = m < 0 ? std::cos(k * phi) : std::sin(k * phi);
            const double sign = k % 2 ? 1 : -1;
            values.push_back(std::sqrt(square) * legendre * (m == 0 ? 1 : sign * std::sqrt(2.0) * azimuth));
        }
    }
    return values;
}

std::string rtiBasisName(RtiBasis basis)
{
    return basis == RtiBasis::ptm ? "ptm" : "hsh";
}

size_t rtiTermCount(RtiBasis basis)
{
    return basis == RtiBasis::ptm ? 6 : 9;
}

std::vector<double> rtiWeights(RtiBasis basis, const glm::vec3& light)
{
    return basis == RtiBasis::ptm ? biquadratic(light.x, light.y) : hemisphericalHarmonics(light, 2);
}

Image relit(const RtiPicture& picture, const glm::vec3& light, int threads)
{
    const std::vector<double> weights = rtiWeights(picture.basis, light);
    Image result(picture.width(), picture.height(), 3);
    for (size_t k = 0; k < weights.size(); ++k) {
        addScaled(result, picture.terms[k], static_cast<float>(weights[k]), threads);
    }
    for (float& value : result.values) {
        value = std::round(255 * std::clamp(value, 0.0f, 1.0f)) / 255;
    }
    return result;
}

std::vector<glm::vec3> rtiLights(int count)
{
    return spiral(count, 0);
}

std::vector<glm::vec3> rtiCheckLights()
{
    return spiral(kCheckLights, kCheckTurn);
}

std::vector<RtiPicture> fitRti(const PictureUnderLight& pictureUnder, std::span<const RtiBasis> bases,
                               std::span<const glm::vec3> lights, int threads)
{
    std::vector<RtiPicture> fits;
    std::vector<Matrix> inverses;
    for (const RtiBasis basis : bases) {
        fits.push_back({basis, std::vector<Image>(rtiTermCount(basis))});
        inverses.push_back(pseudoInverse(basis, lights));
    }
    for (size_t light = 0; light < lights.size(); ++light) {
        const Image picture = pictureUnder(lights[light]);
        for (size_t b = 0; b < fits.size(); ++b) {
            for (size_t k = 0; k < fits[b].terms.size(); ++k) {
                Image& term = fits[b].terms[k];
                if (light == 0) {
                    term = Image(picture.width, picture.height, 3);
                }
                addScaled(term, picture, static_cast<float>(inverses[b][k][light]), threads);
            }
        }
    }
    return fits;
}

double rtiPsnr(const RtiPicture& picture, const PictureUnderLight& pictureUnder, std::span<const glm::vec3> lights,
               std::span<const uint8_t> mask, int threads)
{
    double error = 0;
    for (const glm::vec3& light : lights) {
        error += std::pow(10, -picturePsnr(relit(picture, light, threads), pictureUnder(light), mask) / 10);
    }
    return -10 * std::log10(error / static_cast<double>(lights.size()));
}

} // namespace nacre
