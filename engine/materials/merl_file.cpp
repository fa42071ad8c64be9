#include "engine/materials/merl_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace {

constexpr int kThetaH = 90, kThetaD = 90, kPhiD = 180;
constexpr size_t kCells = size_t{kThetaH} * kThetaD * kPhiD;
constexpr size_t kMerlHeaderBytes = 3 * sizeof(int32_t);
constexpr size_t kFileBytes = kMerlHeaderBytes + 3 * kCells * sizeof(double);
constexpr std::array<double, 3> kScale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr const char* kMerlFile = "a MERL file of 90x90x180 cells, 34992012 bytes";

size_t cellIndex(int i, int j, int k)
{
    return (static_cast<size_t>(i) * kThetaD + j) * kPhiD + k;
}

// Cell coordinates: whole numbers are centres.
vec3 cellFromHalfDifference(const HalfDifference& c)
{
    return vec3(sqrt(c.thetaH / kHalfPi) * kThetaH, c.thetaD / kHalfPi * kThetaD, c.phiD / kPi * kPhiD) - 0.5f;
}

HalfDifference halfDifferenceFromCell(int i, int j, int k)
{
    const float u = (i + 0.5f) / kThetaH;
    return {u * u * kHalfPi, (j + 0.5f) / kThetaD * kHalfPi, (k + 0.5f) / kPhiD * kPi};
}

struct Cells {
    std::vector<vec3> values;
    std::vector<uint8_t> measured;
};

Cells cellsOf(const std::filesystem::path& file, const std::string& bytes)
{
    const auto numberAt = [&](size_t index) {
        double number;
        std::memcpy(&number, bytes.data() + kMerlHeaderBytes + index * sizeof(double), sizeof(double));
        return number;
    };
    Cells cells{std::vector<vec3>(kCells, vec3(0)), std::vector<uint8_t>(kCells, 1)};
    for (size_t cell = 0; cell < kCells; ++cell) {
        for (int c = 0; c < 3; ++c) {
            const double f = numberAt(c * kCells + cell) * kScale[c];
            if (!std::isfinite(f)) {
                throw Error(file, fmt::format("holds a value that is no number at cell {}", cell), kMerlFile);
            }
            cells.values[cell][c] = static_cast<float>(f);
            cells.measured[cell] &= f >= 0;
        }
    }
    return cells;
}

void checkShape(const std::filesystem::path& file, const std::string& bytes)
{
    if (bytes.size() < kMerlHeaderBytes) {
        throw Error(file, fmt::format("has {} bytes", bytes.size()), kMerlFile);
    }
    std::array<int32_t, 3> shape;
    std::memcpy(shape.data(), bytes.data(), kMerlHeaderBytes);
    if (shape != std::array<int32_t, 3>{kThetaH, kThetaD, kPhiD}) {
        throw Error(file, fmt::format("begins with the shape {}x{}x{}", shape[0], shape[1], shape[2]), kMerlFile);
    }
    if (bytes.size() != kFileBytes) {
        throw Error(
            file,
            fmt::format("has {} bytes and is {}", bytes.size(), bytes.size() < kFileBytes ? "cut short" : "too long"),
            kMerlFile);
    }
}

// Trilinear between the measured cells; by reciprocity and isotropy phiD has the period pi. The confidence is the
// share of the weights that fell on measured cells.
BrdfValue sampleCells(const Cells& cells, const HalfDifference& c)
{
    const vec3 position = cellFromHalfDifference(c);
    const vec3 floor = glm::floor(position);
    vec3 sum(0);
    float weight = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::ivec3 at = glm::ivec3(floor) + step;
        const vec3 share = glm::mix(1.0f - (position - floor), position - floor, vec3(step));
        const size_t cell =
            cellIndex(glm::clamp(at.x, 0, kThetaH - 1), glm::clamp(at.y, 0, kThetaD - 1), (at.z + kPhiD) % kPhiD);
        if (cells.measured[cell]) {
            const float w = share.x * share.y * share.z;
            sum += w * cells.values[cell];
            weight += w;
        }
    }
    return {weight > 0 ? sum / weight : vec3(0), weight};
}

BrdfValue sampleFolded(const Cells& cells, const HalfDifference& c)
{
    const BrdfValue a = sampleCells(cells, c);
    const BrdfValue b = sampleCells(cells, {c.thetaH, c.thetaD, kPi - c.phiD});
    const float weight = a.confidence + b.confidence;
    return {weight > 0 ? (a.confidence * a.value + b.confidence * b.value) / weight : vec3(0),
            min(max(a.confidence, b.confidence), 1.0f)};
}

} // namespace

BrdfTable loadMerl(const std::filesystem::path& file, const glm::ivec3& size)
{
    const std::string bytes = readWholeFile(file, kMerlFile);
    checkShape(file, bytes);
    const Cells cells = cellsOf(file, bytes);
    BrdfTable table(size, {kHalfDifference, kHalfPi});
    const vec3 last = glm::max(vec3(size) - 1.0f, vec3(1.0f));
    for (size_t texel = 0; texel < table.values.size(); ++texel) {
        const glm::ivec3 at(texel % size.x, texel / size.x % size.y, texel / size.x / size.y);
        const BrdfValue f = sampleFolded(cells, halfDifferenceFromUnit(vec3(at) / last, table.domain));
        table.values[texel] = f.value;
        table.confidence[texel] = f.confidence;
    }
    fillUncovered(table);
    return table;
}

void saveMerl(const std::filesystem::path& file, const BrdfModel& model, int threads)
{
    std::vector<unsigned char> bytes(kFileBytes);
    const std::array<int32_t, 3> shape{kThetaH, kThetaD, kPhiD};
    std::memcpy(bytes.data(), shape.data(), kMerlHeaderBytes);
    parallelFor(size_t{kThetaH} * kThetaD, 64, threads, [&](size_t first, size_t end) {
        for (size_t row = first; row < end; ++row) {
            for (int k = 0; k < kPhiD; ++k) {
                const int i = static_cast<int>(row / kThetaD), j = static_cast<int>(row % kThetaD);
                const BrdfValue f = foldedValue(model, halfDifferenceFromCell(i, j, k));
                for (int c = 0; c < 3; ++c) {
                    const double number = f.confidence > 0 ? max(f.value[c], 0.0f) / kScale[c] : -1.0;
                    std::memcpy(&bytes[kMerlHeaderBytes + (c * kCells + cellIndex(i, j, k)) * sizeof(double)], &number,
                                sizeof(double));
                }
            }
        }
    });
    writeWholeFile(file, bytes);
}

} // namespace nacre
