#include "acquisition/exchange/rgl_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/brdf/cornell_samples.h"
#include "engine/brdf/rgl_brdf.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

constexpr int kIncidentAngles = 18; // polar angles, 0 to 85 degrees
constexpr int kHalfPolars = 128;    // of the half vector, even in the square root of its angle
constexpr int kHalfAzimuths = 64;
constexpr int kPlaces = 64; // squared: places to which the densities warp the square
constexpr int kWavelengths = 31;
constexpr double kLeastDensity = 0.01; // of the largest: what reflects no light back still has to be looked up

const glm::vec3 kSurfaceNormal(0, 0, 1);

float luminanceOf(const glm::vec3& rec709)
{
    return glm::dot(rec709, {0.2126f, 0.7152f, 0.0722f});
}

double polarFromUnit(double unit)
{
    return unit * unit * glm::pi<double>() / 2;
}

glm::vec3 directionFromAngles(double theta, double phi)
{
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Dupuy and Jakob 2018 (see RglBrdf): facets from what is reflected back, which is where the material's own lobe shows.
// Any density will do, as what is stored is divided by it; the better it follows the lobe, the fewer places hold it.
ParameterisedGrid facetsOf(const BrdfModel& model)
{
    std::vector<float> row;
    for (int x = 0; x < kHalfPolars; ++x) {
        const double theta = polarFromUnit(x / (kHalfPolars - 1.0));
        const glm::vec3 back = directionFromAngles(std::min(theta, glm::radians(85.0)), 0);
        row.push_back(luminanceOf(evaluate(model, kSurfaceNormal, back, back)) *
                      static_cast<float>(std::pow(std::cos(theta), 2)));
    }
    const float largest = std::max(1e-6f, *std::max_element(row.begin(), row.end()));
    for (float& value : row) {
        value = std::max(value, static_cast<float>(kLeastDensity) * largest);
    }
    std::vector<float> both = row; // of two azimuths, since a grid has two rows or more
    both.insert(both.end(), row.begin(), row.end());
    return {kHalfPolars, 2, {0.0f}, std::move(both)};
}

// Facets that are seen from a direction, by the unit square of half vectors, azimuths about that direction's own.
std::vector<float> visibleFacets(const ParameterisedGrid& facets, double thetaL)
{
    const glm::vec3 l = directionFromAngles(thetaL, 0);
    std::vector<float> density;
    for (int y = 0; y < kHalfAzimuths; ++y) {
        for (int x = 0; x < kHalfPolars; ++x) {
            const double unit = x / (kHalfPolars - 1.0), theta = polarFromUnit(unit),
                         phi = (2 * y / (kHalfAzimuths - 1.0) - 1) * glm::pi<double>();
            const double seen = std::max(0.0f, glm::dot(directionFromAngles(theta, phi), l));
            // Solid angle per unit of the square: pi u du by 2 pi dv, times sin theta.
            density.push_back(static_cast<float>(facets.evaluate({unit, 0}, 0) * seen * 2 * glm::pi<double>() *
                                                 glm::pi<double>() * unit * std::sin(theta)));
        }
    }
    return density;
}

// Their area, as the grid's trapezoids sum it.
float areaOf(const std::vector<float>& density)
{
    double sum = 0;
    for (int y = 0; y < kHalfAzimuths; ++y) {
        for (int x = 0; x < kHalfPolars; ++x) {
            const double corner =
                (x == 0 || x + 1 == kHalfPolars ? 0.5 : 1) * (y == 0 || y + 1 == kHalfAzimuths ? 0.5 : 1);
            sum += corner * density[static_cast<size_t>(y) * kHalfPolars + x];
        }
    }
    return static_cast<float>(sum / ((kHalfPolars - 1) * (kHalfAzimuths - 1)));
}

// Where the warp comes from: uniformFromUnit's inverse, by halving. Its second coordinate goes with that of `unit`
// alone.
glm::dvec2 unitFromUniform(const WarpedGrid& warp, const glm::dvec2& uniform, double thetaL)
{
    glm::dvec2 low(0), high(1);
    for (const int axis : {1, 0}) {
        for (int step = 0; step < 30; ++step) {
            glm::dvec2 middle = (low + high) / 2.0;
            middle.y = axis == 0 ? low.y : middle.y;
            const bool isBelow = warp.uniformFromUnit(middle, thetaL)[axis] < uniform[axis];
            (isBelow ? low : high)[axis] = middle[axis];
        }
    }
    return low;
}

struct StoredMaterial {
    std::vector<float> incident;      // radians
    std::vector<float> facets, areas; // 2 x kHalfPolars, 2 x kHalfPolars
    std::vector<float> visible;       // kIncidentAngles x kHalfAzimuths x kHalfPolars
    std::vector<glm::vec3> values;    // kIncidentAngles x kPlaces x kPlaces: f n.v 4 sigma / D
};

StoredMaterial storedFrom(const BrdfModel& model, int threads)
{
    StoredMaterial stored;
    const ParameterisedGrid facets = facetsOf(model);
    for (int i = 0; i < 2 * kHalfPolars; ++i) {
        const double unit = i % kHalfPolars / (kHalfPolars - 1.0);
        stored.facets.push_back(static_cast<float>(facets.evaluate({unit, 0}, 0)));
        stored.areas.push_back(std::max(1e-6f, areaOf(visibleFacets(facets, polarFromUnit(unit)))));
    }
    const ParameterisedGrid areas(kHalfPolars, 2, {0.0f}, stored.areas);
    for (int i = 0; i < kIncidentAngles; ++i) {
        stored.incident.push_back(glm::radians(5.0f * static_cast<float>(i)));
        const std::vector<float> slice = visibleFacets(facets, stored.incident.back());
        stored.visible.insert(stored.visible.end(), slice.begin(), slice.end());
    }
    const WarpedGrid warp(kHalfPolars, kHalfAzimuths, stored.incident, stored.visible);
    stored.values.resize(size_t{kIncidentAngles} * kPlaces * kPlaces);
    parallelFor(stored.values.size(), 64, threads, [&](size_t first, size_t last) {
        for (size_t k = first; k < last; ++k) {
            const double thetaL = stored.incident[k / (kPlaces * kPlaces)];
            const glm::dvec2 uniform(static_cast<double>(k % kPlaces) / (kPlaces - 1),
                                     static_cast<double>(k / kPlaces % kPlaces) / (kPlaces - 1));
            const glm::dvec2 unit = unitFromUniform(warp, uniform, thetaL);
            const glm::vec3 l = directionFromAngles(thetaL, 0),
                            h = directionFromAngles(polarFromUnit(unit.x), (2 * unit.y - 1) * glm::pi<double>());
            const glm::vec3 v = 2 * glm::dot(l, h) * h - l;
            if (v.z > 0) { // else what is mirrored there goes into the surface
                const double area = areas.evaluate({std::sqrt(thetaL * 2 / glm::pi<double>()), 0}, 0);
                stored.values[k] = glm::max(glm::vec3(0), evaluate(model, kSurfaceNormal, l, v)) *
                                   static_cast<float>(v.z * 4 * area / facets.evaluate(unit, 0));
            }
        }
    });
    return stored;
}

// Rows: the smoothest spectra whose colours are red, green and blue of Rec. 709; they sum to 1, which is white.
Eigen::MatrixXd primarySpectra(const std::vector<float>& wavelengths)
{
    constexpr int n = kWavelengths;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3), bend = Eigen::MatrixXd::Zero(n - 2, n);
    for (int i = 0; i + 2 < n; ++i) {
        bend.row(i).segment<3>(i) << 1, -2, 1;
    }
    for (int i = 0; i < n; ++i) {
        std::vector<float> one(n, 0.0f);
        one[i] = 1;
        const glm::vec3 colour = rec709FromReflectance(wavelengths, one);
        for (int c = 0; c < 3; ++c) {
            system(n + c, i) = system(i, n + c) = colour[c];
        }
    }
    system.topLeftCorner(n, n) = bend.transpose() * bend; // least squares under three conditions
    Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(n + 3, 3);
    wanted.bottomRows(3).setIdentity();
    return system.fullPivLu().solve(wanted).topRows(n).transpose();
}

// Little-endian, as RglBrdf reads it.
class TensorFile {
public:
    template <class Value>
    void add(const std::string& name, const std::vector<uint64_t>& shape, const std::vector<Value>& values)
    {
        const auto* bytes = reinterpret_cast<const char*>(values.data());
        arrays_.push_back(
            {name, shape, sizeof(Value) == 1 ? kBytes : kFloats, std::string(bytes, values.size() * sizeof(Value))});
    }
    std::string bytes() const
    {
        uint64_t offset = 18;
        for (const Array& array : arrays_) {
            offset += 2 + array.name.size() + 2 + 1 + 8 + 8 * array.shape.size();
        }
        std::string header("tensor_file\0\1\0", 14), data;
        append(static_cast<uint32_t>(arrays_.size()), header);
        data.resize((8 - offset % 8) % 8);
        for (const Array& array : arrays_) {
            append(static_cast<uint16_t>(array.name.size()), header);
            header += array.name;
            append(static_cast<uint16_t>(array.shape.size()), header);
            append(array.type, header);
            append(offset + data.size(), header);
            for (const uint64_t side : array.shape) {
                append(side, header);
            }
            data += array.data;
            data.resize((data.size() + offset + 7) / 8 * 8 - offset); // whole words, for readers that map the file
        }
        return header + data;
    }

private:
    static constexpr uint8_t kBytes = 1, kFloats = 10; // the format's codes of element types
    struct Array {
        std::string name;
        std::vector<uint64_t> shape;
        uint8_t type;
        std::string data;
    };
    template <class Value> static void append(Value value, std::string& to)
    {
        to.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    std::vector<Array> arrays_;
};

} // namespace

void saveRgl(const std::filesystem::path& file, const BrdfModel& model, const std::string& description, int threads)
{
    const StoredMaterial stored = storedFrom(model, threads);
    std::vector<float> wavelengths, rgb, spectra, luminances;
    for (int i = 0; i < kWavelengths; ++i) {
        wavelengths.push_back(400.0f + 10.0f * static_cast<float>(i));
    }
    const Eigen::MatrixXd primaries = primarySpectra(wavelengths);
    constexpr size_t kSlice = size_t{kPlaces} * kPlaces;
    for (auto slice = stored.values.begin(); slice != stored.values.end(); slice += kSlice) {
        for (int c = 0; c < 3; ++c) {
            std::transform(slice, slice + kSlice, std::back_inserter(rgb), [&](const glm::vec3& v) { return v[c]; });
        }
        for (int i = 0; i < kWavelengths; ++i) {
            const glm::vec3 weights(primaries(0, i), primaries(1, i), primaries(2, i));
            std::transform(slice, slice + kSlice, std::back_inserter(spectra),
                           [&](const glm::vec3& v) { return std::max(0.0f, glm::dot(weights, v)); });
        }
        std::transform(slice, slice + kSlice, std::back_inserter(luminances),
                       [](const glm::vec3& v) { return std::max(1e-6f, luminanceOf(v)); }); // it is sampled by
    }
    constexpr uint64_t n = kIncidentAngles, s = kPlaces;
    TensorFile tensors;
    tensors.add("description", {description.size()}, std::vector<char>(description.begin(), description.end()));
    tensors.add("jacobian", {1}, std::vector<uint8_t>{1});
    tensors.add("phi_i", {1}, std::vector<float>{0});
    tensors.add("theta_i", {n}, stored.incident);
    tensors.add("ndf", {2, kHalfPolars}, stored.facets);
    tensors.add("sigma", {2, kHalfPolars}, stored.areas);
    tensors.add("vndf", {1, n, kHalfAzimuths, kHalfPolars}, stored.visible);
    tensors.add("luminance", {1, n, s, s}, luminances);
    tensors.add("rgb", {1, n, 3, s, s}, rgb);
    tensors.add("wavelengths", {kWavelengths}, wavelengths);
    tensors.add("spectra", {1, n, kWavelengths, s, s}, spectra);
    writeTextFile(file, tensors.bytes());
}

} // namespace nacre
