#include "engine/brdf/rgl_brdf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "shared/brdf_coords.h"

namespace nacre {

namespace {

// The container of the RGL material database (Dupuy and Jakob, An Adaptive Parameterization for Efficient Material
// Acquisition and Rendering, 2018): named arrays of any dimension, little-endian, the last index running fastest.
struct Tensor {
    std::vector<uint64_t> shape;
    std::vector<float> numbers; // of float32 arrays
    std::string bytes;          // of uint8 arrays

    size_t size() const;
};

constexpr const char kMagic[12] = "tensor_file"; // with the 0 that ends it
constexpr uint8_t kUint8 = 1;                    // the format's codes of element types
constexpr uint8_t kFloat32 = 10;
constexpr uint32_t kMostArrays = 1000;
constexpr uint16_t kMostDimensions = 16;

// Walks the header; what lies beyond the end is an error of the file.
class Cursor {
public:
    Cursor(const std::filesystem::path& file, const std::string& bytes) : file_(file), bytes_(bytes) {}

    template <class T> T read()
    {
        T value;
        std::memcpy(&value, text(sizeof(T)), sizeof(T));
        return value;
    }
    const char* text(size_t count)
    {
        if (bytes_.size() - at_ < count) {
            throw Error(file_, "ends within its header", "a whole tensor file");
        }
        at_ += count;
        return bytes_.data() + at_ - count;
    }

private:
    const std::filesystem::path& file_;
    const std::string& bytes_;
    size_t at_ = 0;
};

// Elements of `shape`, or more than any file holds where the product does not fit.
uint64_t elementCount(const std::vector<uint64_t>& shape)
{
    uint64_t count = 1;
    for (uint64_t n : shape) {
        if (n != 0 && count > std::numeric_limits<uint64_t>::max() / 16 / n) {
            return std::numeric_limits<uint64_t>::max() / 16;
        }
        count *= n;
    }
    return count;
}

Tensor readArray(const std::filesystem::path& file, const std::string& name, const std::string& bytes, uint8_t type,
                 uint64_t offset, std::vector<uint64_t> shape)
{
    const uint64_t length = elementCount(shape) * (type == kFloat32 ? sizeof(float) : 1);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        throw Error(file, fmt::format("is cut short: '{}' ends at byte {} of {}", name, offset + length, bytes.size()),
                    "a whole tensor file");
    }
    Tensor tensor{std::move(shape), {}, {}};
    if (type == kFloat32) {
        tensor.numbers.resize(length / sizeof(float));
        std::memcpy(tensor.numbers.data(), bytes.data() + offset, length);
    } else {
        tensor.bytes = bytes.substr(offset, length);
    }
    return tensor;
}

size_t Tensor::size() const
{
    return numbers.size() + bytes.size();
}

// The arrays of float32 and uint8 by name; others are left out. Throws Error where the file is cut short, is no tensor
// file, or has an array that lies outside of it.
std::map<std::string, Tensor> loadTensorFile(const std::filesystem::path& file)
{
    const std::string bytes = readWholeFile(file, "a .bsdf of the RGL material database");
    Cursor cursor(file, bytes);
    if (bytes.size() < sizeof(kMagic) || std::memcmp(cursor.text(sizeof(kMagic)), kMagic, sizeof(kMagic)) != 0) {
        throw Error(file, "is no tensor file", "a .bsdf of the RGL material database");
    }
    const auto major = cursor.read<uint8_t>(), minor = cursor.read<uint8_t>();
    const auto count = cursor.read<uint32_t>();
    if (major != 1 || minor != 0 || count > kMostArrays) {
        throw Error(file, fmt::format("has version {}.{} and {} arrays", major, minor, count), "version 1.0");
    }
    std::map<std::string, Tensor> tensors;
    for (uint32_t i = 0; i < count; ++i) {
        const auto nameLength = cursor.read<uint16_t>();
        const std::string name(cursor.text(nameLength), nameLength);
        const auto dimensions = cursor.read<uint16_t>();
        const auto type = cursor.read<uint8_t>();
        const auto offset = cursor.read<uint64_t>();
        if (dimensions > kMostDimensions) {
            throw Error(file, fmt::format("gives '{}' {} dimensions", name, dimensions), "a tensor file");
        }
        std::vector<uint64_t> shape;
        for (int d = 0; d < dimensions; ++d) {
            shape.push_back(cursor.read<uint64_t>());
        }
        if (type == kFloat32 || type == kUint8) {
            tensors[name] = readArray(file, name, bytes, type, offset, std::move(shape));
        }
    }
    return tensors;
}

} // namespace

ParameterisedGrid::ParameterisedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values)
    : width_(width), height_(height), parameters_(std::move(parameters)), values_(std::move(values))
{
    assert(width >= 2 && height >= 2 && !parameters_.empty());
    assert(values_.size() == static_cast<size_t>(width) * height * parameters_.size());
}

ParameterisedGrid::Slices ParameterisedGrid::slicesAt(double parameter, size_t sliceSize) const
{
    const auto above = std::upper_bound(parameters_.begin(), parameters_.end(), parameter);
    const size_t second = std::min<size_t>(above - parameters_.begin(), parameters_.size() - 1);
    const size_t first = above == parameters_.begin() ? 0 : above - parameters_.begin() - 1;
    const double step = static_cast<double>(parameters_[second]) - parameters_[first];
    return {first * sliceSize, second * sliceSize, step > 0 ? (parameter - parameters_[first]) / step : 0};
}

ParameterisedGrid::Patch ParameterisedGrid::patchAt(const glm::dvec2& unit) const
{
    const double x = std::clamp(unit.x, 0.0, 1.0) * (width_ - 1), y = std::clamp(unit.y, 0.0, 1.0) * (height_ - 1);
    Patch patch{std::min(static_cast<int>(x), width_ - 2), std::min(static_cast<int>(y), height_ - 2), {}};
    patch.within = {x - patch.x, y - patch.y};
    return patch;
}

double ParameterisedGrid::evaluate(const glm::dvec2& unit, double parameter) const
{
    const Slices slices = slicesAt(parameter, static_cast<size_t>(width_) * height_);
    const Patch p = patchAt(unit);
    const auto bilinear = [&](size_t slice) {
        const float* row = &values_[slice + static_cast<size_t>(p.y) * width_ + p.x];
        const float* next = row + width_;
        return std::lerp(std::lerp<double>(row[0], row[1], p.within.x), std::lerp<double>(next[0], next[1], p.within.x),
                         p.within.y);
    };
    return std::lerp(bilinear(slices.first), bilinear(slices.second), slices.share);
}

WarpedGrid::WarpedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values)
    : ParameterisedGrid(width, height, std::move(parameters), std::move(values)), rowSums_(values_.size(), 0.0f)
{
    for (size_t slice = 0; slice < parameters_.size(); ++slice) {
        float* density = &values_[slice * width_ * height_];
        float* rows = &rowSums_[slice * width_ * height_];
        std::vector<double> square(height_, 0.0), total(height_, 0.0);
        std::vector<double> sums(static_cast<size_t>(width_) * height_, 0.0);
        for (int y = 0; y < height_; ++y) {
            for (int x = 1; x < width_; ++x) {
                const size_t i = static_cast<size_t>(y) * width_ + x;
                total[y] += 0.5 * (static_cast<double>(density[i - 1]) + density[i]);
                sums[i] = total[y];
            }
            square[y] = y == 0 ? 0.0 : square[y - 1] + 0.5 * (total[y - 1] + total[y]);
        }
        const double scale = 1 / square.back();
        for (size_t i = 0; i < sums.size(); ++i) {
            rows[i] = static_cast<float>(sums[i] * scale);
            density[i] = static_cast<float>(density[i] * scale);
        }
        for (double s : square) {
            squareSums_.push_back(static_cast<float>(s * scale));
        }
    }
}

// Within a patch the density is bilinear, so its sums are quadratic: u d0 + u^2/2 (d1 - d0) from the patch's edge.
glm::dvec2 WarpedGrid::uniformFromUnit(const glm::dvec2& unit, double parameter) const
{
    const Slices slices = slicesAt(parameter, static_cast<size_t>(width_) * height_);
    const Slices columns = slicesAt(parameter, height_);
    const Patch p = patchAt(unit);
    const auto at = [](const std::vector<float>& values, const Slices& s, size_t index) {
        return std::lerp<double>(values[s.first + index], values[s.second + index], s.share);
    };
    const auto partial = [](double u, double d0, double d1) { return u * (d0 + 0.5 * u * (d1 - d0)); };

    const size_t row = static_cast<size_t>(p.y) * width_, next = row + width_;
    const double left = std::lerp(at(values_, slices, row + p.x), at(values_, slices, next + p.x), p.within.y);
    const double right = std::lerp(at(values_, slices, row + p.x + 1), at(values_, slices, next + p.x + 1), p.within.y);
    const double before = std::lerp(at(rowSums_, slices, row + p.x), at(rowSums_, slices, next + p.x), p.within.y);
    const double rowTotal = at(rowSums_, slices, row + width_ - 1), nextTotal = at(rowSums_, slices, next + width_ - 1);
    const double total = std::lerp(rowTotal, nextTotal, p.within.y);
    const double x = total > 0 ? (before + partial(p.within.x, left, right)) / total : 0.0;
    const double y = at(squareSums_, columns, p.y) + partial(p.within.y, rowTotal, nextTotal);
    return {x, y};
}

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
