#pragma once
#include <functional>
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
};

PredictedBall makePredictedBall(int size, const std::vector<glm::vec3>& directions, const GreyReflectance& reflectance,
                                int threads);

} // namespace nacre
