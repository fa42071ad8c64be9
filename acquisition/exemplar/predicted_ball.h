#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// Grey f(n, l, v = (0,0,1)) of a candidate reflectance.
using GreyReflectance = std::function<float(const glm::vec3& n, const glm::vec3& l)>;

// The reference balls of one reflectance, one per light of the capture, turned around: for each texel of the disc of
// normals the column f(n, l_i, v) max(0, n.l_i) over the lights, which is what a pixel with that normal shows, up to
// its albedo. Columns are padded with zeros to a multiple of eight.
struct PredictedBall {
    int size = 0; // texels across the disc
    size_t lightCount = 0;
    size_t stride = 0;
    std::vector<int> rows;          // size x size: index of the texel's column, -1 beyond the rim
    std::vector<glm::vec3> normals; // per column
    std::vector<float> columns;     // [row * stride + light]
    std::vector<float> roots;       // their square roots

    const float* column(int row) const { return &columns[row * stride]; }
    // The row whose texel holds the normal, or its nearest inside the rim.
    int rowOf(const glm::vec3& normal) const;
    // The four columns around a normal, bilinearly mixed; rowOf's at the rim, where one of them is missing. `mixed` has
    // stride floats.
    void mixColumns(const glm::vec3& normal, float* mixed) const;
};

// A place on the ball between four columns.
struct BallCell {
    std::array<const float*, 4> columns{}; // of the texels (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
    float u = 0, v = 0;                    // from x and y on, [0, 1]
};

// Texel coordinates, (0, 0) at the centre of the top left texel, and back.
glm::vec2 ballTexelOf(const glm::vec3& normal, int size);
glm::vec3 normalOfBallTexel(const glm::vec2& texel, int size);

// Empty at the rim.
std::optional<BallCell> findBallCell(const PredictedBall& ball, const glm::vec2& texel);

PredictedBall makePredictedBall(int size, const std::vector<glm::vec3>& directions, const GreyReflectance& reflectance,
                                int threads);

} // namespace nacre
