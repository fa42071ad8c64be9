#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "shared/brdf_coords.h"

namespace nacre {

// f in 1/sr (or up to the capture's one scale factor), cosine NOT included, on the grid of brdf_coords.h.
// Texel (i, j, k) lies at (k * size.y + j) * size.x + i; i runs over unit.x (thetaH or thetaI).
struct BrdfTable {
    glm::ivec3 size{0, 0, 0};
    TableDomain domain{kHalfDifference, kHalfPi};
    std::vector<glm::vec3> values;
    // Coverage: 1 where samples lie within a texel's reach, falling to 0 with the distance to the nearest sample.
    std::vector<float> confidence;
    // Expected relative error of f: nine of ten texels lie within theirs. Empty where nobody tells.
    std::vector<float> error;

    BrdfTable() = default;
    BrdfTable(glm::ivec3 s, TableDomain d)
        : size(s), domain(d), values(static_cast<size_t>(s.x) * s.y * s.z, glm::vec3(0)),
          confidence(values.size(), 0.0f)
    {
    }
    size_t index(int i, int j, int k) const { return (static_cast<size_t>(k) * size.y + j) * size.x + i; }
    // Directions of a texel's centre, tangent frame.
    LightView directions(int i, int j, int k) const;
};

// Where the measured samples of a table lie, on the table's own grid; empty for tables that were not measured.
struct Coverage {
    std::vector<float> distance; // radians to the nearest sample, in raw angles
    std::vector<float> count;    // samples nearest to the texel
};

struct BrdfValue {
    glm::vec3 value;  // 1/sr
    float confidence; // [0,1]
};

// Trilinear, as the sampler of the GPU does it. unit in [0,1]^3.
BrdfValue sampleTable(const BrdfTable& table, const glm::vec3& unit);

// The expected relative error of a texel, by its coverage where the table tells none (shared/coverage.h); and between
// texels, where their errors are taken to go the same way, so that they are interpolated like f.
float expectedError(const BrdfTable& table, size_t texel);
float sampleError(const BrdfTable& table, const glm::vec3& unit);

// f(n, l, v) of the table; l and v above the horizon of n, or the border's value is returned.
BrdfValue evaluateTable(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// "half-difference", "natural", "one-way", as files have them; what is named otherwise is none.
std::string nameOfCoordinates(int coordinates);
std::optional<int> coordinatesFromName(const std::string& name);

// Version, shape and domain on one line, as files' metadata have it (docs/formats.md).
std::string describeShape(const BrdfTable& table);

// One EXR of size.z slices side by side (size.x * size.z by size.y), RGB = f, A = confidence, and the error as a fifth
// channel where it is told; shape and domain in its metadata (docs/formats.md).
void saveBrdfTable(const std::filesystem::path& file, const BrdfTable& table);
BrdfTable loadBrdfTable(const std::filesystem::path& file);

// The same atlas with two channels, distance and count.
void saveCoverage(const std::filesystem::path& file, const glm::ivec3& size, const Coverage& coverage);
Coverage loadCoverage(const std::filesystem::path& file, const glm::ivec3& size);

} // namespace nacre
