#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

// Unit normals in the camera frame, row 0 on top, with confidence in [0,1] (0 = no data; the normal is then 0).
struct NormalMap {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> normals;
    std::vector<float> confidence;

    NormalMap() = default;
    NormalMap(int w, int h)
        : width(w), height(h), normals(static_cast<size_t>(w) * h, glm::vec3(0)), confidence(normals.size(), 0.0f)
    {
    }
    size_t index(int x, int y) const { return static_cast<size_t>(y) * width + x; }
};

// Which way green points in an integer normal map: up (OpenGL) or down (DirectX).
enum class NormalY { gl, dx };

// EXR and other float pictures: x,y,z (and A = confidence where there). Integer pictures: n = 2 v - 1, black = no data.
// Normals are normalised; NaN, and a map without any normal, are errors.
NormalMap loadNormalMap(const std::filesystem::path& file, NormalY normalY = NormalY::gl);

// EXR with R,G,B = x,y,z and A = confidence; PNG 16-bit n = 2 v - 1.
void saveNormalMap(const std::filesystem::path& file, const NormalMap& map);

// For each pixel of a width x height picture, the pixel that it shows of one of another size that is fitted into it,
// centred with its aspect kept; -1 outside.
std::vector<int64_t> fittedPixels(int fromWidth, int fromHeight, int width, int height);

// Nearest-sample copy at another size, centred with its aspect kept; what is outside has no data.
NormalMap fittedNormalMap(const NormalMap& map, int width, int height);

// Normals of the visible hemisphere of a sphere that fills the picture: the reference ball's own surface.
NormalMap sphereNormalMap(int size);

struct AngularError {
    double mean = 0; // degrees
    double median = 0;
    double percentile95 = 0;
    size_t pixels = 0;  // compared
    size_t missing = 0; // in the mask without a normal: counted as 90 degrees
};

// Over mask pixels where truth has data.
AngularError angularError(const NormalMap& normals, const NormalMap& truth, std::span<const uint8_t> mask);

} // namespace nacre
