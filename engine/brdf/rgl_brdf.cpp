#include "engine/brdf/rgl_brdf.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "engine/brdf/tensor_file.h"
#include "engine/files/error.h"
#include "shared/brdf_coords.h"

namespace nacre {
namespace {

constexpr double kTau = 6.283185307179586476925;
constexpr const char* kExpected = "an isotropic RGB material of the RGL database";

// Cosine of 87 degrees. Nearer to the horizon what is stored no longer falls with n.v and the quotient would run away
// by a factor of a thousand: f n.v goes to 0 there instead.
constexpr double kStoredGrazingFloor = 0.05;

using Tensors = std::map<std::string, Tensor>;

// The named array of `dimensions`, each index at least 1 long.
const Tensor& arrayOf(const std::filesystem::path& file, const Tensors& tensors, const std::string& name,
                      size_t dimensions)
{
    const auto found = tensors.find(name);
    if (found == tensors.end()) {
        throw Error(file, fmt::format("has no array '{}'", name), kExpected);
    }
    const Tensor& tensor = found->second;
    if (tensor.shape.size() != dimensions || tensor.size() == 0) {
        throw Error(file, fmt::format("'{}' has the shape {}", name, fmt::join(tensor.shape, "x")), kExpected);
    }
    return tensor;
}

const Tensor& numbersOf(const std::filesystem::path& file, const Tensors& tensors, const std::string& name,
                        size_t dimensions)
{
    const Tensor& tensor = arrayOf(file, tensors, name, dimensions);
    if (tensor.numbers.empty() ||
        !std::all_of(tensor.numbers.begin(), tensor.numbers.end(), [](float x) { return std::isfinite(x); })) {
        throw Error(file, fmt::format("'{}' holds values that are no numbers", name), kExpected);
    }
    return tensor;
}

// The last two indices of an array are rows and columns of at least 2.
glm::ivec2 gridSize(const std::filesystem::path& file, const std::string& name, const Tensor& tensor)
{
    const uint64_t height = tensor.shape[tensor.shape.size() - 2], width = tensor.shape.back();
    if (width < 2 || height < 2 || width > 65536 || height > 65536) {
        throw Error(file, fmt::format("'{}' is {}x{}", name, width, height), "grids of 2x2 or more");
    }
    return {static_cast<int>(width), static_cast<int>(height)};
}

ParameterisedGrid plainGrid(const std::filesystem::path& file, const Tensors& tensors, const std::string& name)
{
    const Tensor& tensor = numbersOf(file, tensors, name, 2);
    const glm::ivec2 size = gridSize(file, name, tensor);
    return {size.x, size.y, {0.0f}, tensor.numbers};
}

void requireShape(const std::filesystem::path& file, const std::string& name, const Tensor& tensor, size_t index,
                  size_t expected)
{
    if (tensor.shape[index] != expected) {
        throw Error(file, fmt::format("'{}' has the shape {}", name, fmt::join(tensor.shape, "x")),
                    fmt::format("{} at index {}", expected, index));
    }
}

std::vector<float> incidentAngles(const std::filesystem::path& file, const Tensors& tensors)
{
    if (tensors.contains("spectra") && !tensors.contains("rgb")) {
        throw Error(file, "is spectral", "the database's RGB version of the material (NAME_rgb.bsdf)");
    }
    // Two azimuths are how the database marks a period of half a turn of an isotropic sample.
    const Tensor& azimuths = numbersOf(file, tensors, "phi_i", 1);
    if (azimuths.numbers.size() > 2) {
        throw Error(file, fmt::format("is anisotropic: it was measured from {} azimuths", azimuths.numbers.size()),
                    kExpected);
    }
    std::vector<float> angles = numbersOf(file, tensors, "theta_i", 1).numbers;
    if (std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) != angles.end()) {
        throw Error(file, "'theta_i' does not ascend", kExpected);
    }
    return angles;
}

WarpedGrid densityOf(const std::filesystem::path& file, const Tensors& tensors, const std::vector<float>& angles)
{
    const Tensor& tensor = numbersOf(file, tensors, "vndf", 4);
    const glm::ivec2 size = gridSize(file, "vndf", tensor);
    requireShape(file, "vndf", tensor, 1, angles.size());
    const size_t slice = static_cast<size_t>(size.x) * size.y;
    // Of two azimuths the first serves: they are the same for an isotropic sample.
    const std::vector<float> values(tensor.numbers.begin(), tensor.numbers.begin() + slice * angles.size());
    for (size_t i = 0; i < angles.size(); ++i) {
        const auto first = values.begin() + i * slice;
        const bool hasMass = std::any_of(first, first + slice, [](float x) { return x > 0; });
        if (!hasMass || std::any_of(first, first + slice, [](float x) { return x < 0; })) {
            throw Error(file, "'vndf' holds a slice that is no density", "values of 0 or more, not all 0");
        }
    }
    return {size.x, size.y, angles, values};
}

std::array<ParameterisedGrid, 3> coloursOf(const std::filesystem::path& file, const Tensors& tensors,
                                           const std::vector<float>& angles)
{
    const Tensor& tensor = numbersOf(file, tensors, "rgb", 5);
    const glm::ivec2 size = gridSize(file, "rgb", tensor);
    requireShape(file, "rgb", tensor, 1, angles.size());
    requireShape(file, "rgb", tensor, 2, 3);
    const size_t slice = static_cast<size_t>(size.x) * size.y;
    std::array<ParameterisedGrid, 3> colours;
    for (size_t c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (size_t i = 0; i < angles.size(); ++i) {
            const auto first = tensor.numbers.begin() + (3 * i + c) * slice;
            values.insert(values.end(), first, first + slice);
        }
        colours[c] = ParameterisedGrid(size.x, size.y, angles, std::move(values));
    }
    return colours;
}

double polarAngle(const glm::vec3& direction)
{
    return std::atan2(std::hypot(direction.x, direction.y), direction.z);
}

// The database's unit square of directions: the square root of the polar angle, and the azimuth from -pi.
glm::dvec2 squareFromAngles(double theta, double phi)
{
    const double turn = phi / kTau + 0.5;
    return {std::sqrt(theta * 4 / kTau), turn - std::floor(turn)};
}

} // namespace

RglBrdf::RglBrdf(const std::filesystem::path& file)
{
    const Tensors tensors = loadTensorFile(file);
    const std::vector<float> angles = incidentAngles(file, tensors);
    description_ = arrayOf(file, tensors, "description", 1).bytes;
    hasJacobian_ = arrayOf(file, tensors, "jacobian", 1).bytes != std::string(1, '\0');
    normals_ = plainGrid(file, tensors, "ndf");
    projectedArea_ = plainGrid(file, tensors, "sigma");
    visibleNormals_ = densityOf(file, tensors, angles);
    colour_ = coloursOf(file, tensors, angles);
}

glm::vec3 RglBrdf::evaluate(const glm::vec3& l, const glm::vec3& v) const
{
    const glm::vec3 h = glm::normalize(l + v);
    const double thetaL = polarAngle(l), phiL = std::atan2(l.y, l.x);
    const glm::dvec2 half = squareFromAngles(polarAngle(h), std::atan2(h.y, h.x) - phiL);
    const glm::dvec2 uniform = visibleNormals_.uniformFromUnit(half, thetaL);
    double scale = 1 / std::max<double>(v.z, kStoredGrazingFloor); // what is stored has the cosine of v in it
    if (hasJacobian_) {
        scale *= normals_.evaluate(half, 0) / (4 * projectedArea_.evaluate(squareFromAngles(thetaL, phiL), 0));
    }
    glm::vec3 f;
    for (int c = 0; c < 3; ++c) {
        // Colour conversion has left some values below 0.
        f[c] = static_cast<float>(std::max(0.0, colour_[c].evaluate(uniform, thetaL) * scale));
    }
    return f;
}

} // namespace nacre
