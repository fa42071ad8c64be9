#include "acquisition/normals/smooth_fill.h"

#include <array>
#include <vector>

#include <Eigen/Sparse>
#include <glm/geometric.hpp>

namespace nacre {

namespace {

// A field of three components, known in places.
struct Field {
    int width;
    int height;
    std::vector<glm::vec3> values;
    std::vector<uint8_t> known;
};

// The pixels to be filled and their numbers among the unknowns.
struct FillRegion {
    std::vector<size_t> pixels;
    std::vector<int> numberOf; // -1: not in it
};

// The up to four neighbours inside the picture.
template <class Visit> void forEachNeighbour(const Field& field, size_t pixel, Visit&& visit)
{
    const int x = static_cast<int>(pixel % field.width), y = static_cast<int>(pixel / field.width);
    constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [dx, dy] : kSteps) {
        if (x + dx >= 0 && x + dx < field.width && y + dy >= 0 && y + dy < field.height) {
            visit(static_cast<size_t>(y + dy) * field.width + x + dx);
        }
    }
}

// Flooded from known pixels: a part that touches none has no solution.
FillRegion reachableRegion(const Field& field, const std::vector<uint8_t>& toFill)
{
    FillRegion region;
    region.numberOf.assign(toFill.size(), -1);
    const auto add = [&](size_t pixel) {
        if (toFill[pixel] && region.numberOf[pixel] < 0) {
            region.numberOf[pixel] = static_cast<int>(region.pixels.size());
            region.pixels.push_back(pixel);
        }
    };
    for (size_t pixel = 0; pixel < toFill.size(); ++pixel) {
        if (field.known[pixel]) {
            forEachNeighbour(field, pixel, add);
        }
    }
    for (size_t next = 0; next < region.pixels.size(); ++next) {
        forEachNeighbour(field, region.pixels[next], add);
    }
    return region;
}

// The discrete equation: a pixel is the mean of its neighbours that are to be filled or known.
Eigen::MatrixX3d solveLaplace(const Field& field, const FillRegion& region)
{
    const auto count = static_cast<Eigen::Index>(region.pixels.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
    for (Eigen::Index row = 0; row < count; ++row) {
        double neighbours = 0;
        forEachNeighbour(field, region.pixels[static_cast<size_t>(row)], [&](size_t neighbour) {
            if (region.numberOf[neighbour] >= 0) {
                entries.emplace_back(row, region.numberOf[neighbour], -1.0);
                ++neighbours;
            } else if (field.known[neighbour]) {
                const glm::vec3& value = field.values[neighbour];
                right.row(row) += Eigen::RowVector3d(value.x, value.y, value.z);
                ++neighbours;
            }
        });
        entries.emplace_back(row, row, neighbours);
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    return solver.solve(right);
}

// Forgets what is marked on the object and solves for it: store(pixel, value) for each pixel that was reached.
template <class Store>
void fill(Field field, std::span<const uint8_t> marked, std::span<const uint8_t> object, Store&& store)
{
    std::vector<uint8_t> toFill(marked.size());
    for (size_t i = 0; i < marked.size(); ++i) {
        toFill[i] = marked[i] && object[i];
        field.known[i] = field.known[i] && !toFill[i];
    }
    const FillRegion region = reachableRegion(field, toFill);
    if (region.pixels.empty()) {
        return;
    }
    const Eigen::MatrixX3d solved = solveLaplace(field, region);
    for (size_t i = 0; i < region.pixels.size(); ++i) {
        const Eigen::Vector3f value = solved.row(static_cast<Eigen::Index>(i)).cast<float>();
        store(region.pixels[i], glm::vec3(value.x(), value.y(), value.z()));
    }
}

} // namespace

size_t fillSmoothly(NormalMap& normals, std::span<const uint8_t> marked, std::span<const uint8_t> object)
{
    Field field{normals.width, normals.height, normals.normals, {}};
    for (const float confidence : normals.confidence) {
        field.known.push_back(confidence > 0);
    }
    size_t filled = 0;
    fill(std::move(field), marked, object, [&](size_t pixel, const glm::vec3& value) {
        const float length = glm::length(value);
        normals.normals[pixel] = length > 0 ? value / length : glm::vec3(0);
        normals.confidence[pixel] = length > 0 ? kSmoothedConfidence : 0.0f;
        filled += length > 0;
    });
    return filled;
}

size_t fillSmoothly(Image& rgb, std::span<const uint8_t> marked, std::span<const uint8_t> object)
{
    Field field{rgb.width, rgb.height, {}, {}};
    for (size_t i = 0; i < rgb.pixelCount(); ++i) {
        field.values.emplace_back(rgb.values[3 * i], rgb.values[3 * i + 1], rgb.values[3 * i + 2]);
        field.known.push_back(field.values.back() != glm::vec3(0));
    }
    size_t filled = 0;
    fill(std::move(field), marked, object, [&](size_t pixel, const glm::vec3& value) {
        rgb.setRgb(static_cast<int>(pixel % rgb.width), static_cast<int>(pixel / rgb.width), value);
        ++filled;
    });
    return filled;
}

} // namespace nacre
