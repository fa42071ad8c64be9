#include "engine/brdf/brdf_table.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "engine/files/error.h"
#include "engine/files/image.h"
#include "shared/coverage.h"

namespace nacre {

namespace {

constexpr const char* kShapeAttribute = "nacre:brdfTable";
// By the numbers of brdf_coords.h.
constexpr std::array<const char*, 3> kCoordinateNames{"half-difference", "natural", "one-way"};

BrdfTable tableOfShape(const std::filesystem::path& file, const std::string& shape)
{
    std::istringstream words(shape);
    int version = 0;
    glm::ivec3 size(0);
    std::string coordinates;
    float thetaDMax = 0;
    words >> version >> size.x >> size.y >> size.z >> coordinates >> thetaDMax;
    const std::optional<int> known = coordinatesFromName(coordinates);
    if (!words || version != 1 || !known || glm::min(size.x, glm::min(size.y, size.z)) < 1 || !(thetaDMax > 0) ||
        thetaDMax > kHalfPi * 1.0001f) {
        throw Error(file, shape.empty() ? "holds no BRDF table" : "has a table shape that is not understood: " + shape,
                    fmt::format("the metadata '{}' of version 1", kShapeAttribute));
    }
    return BrdfTable(size, TableDomain{*known, thetaDMax});
}

// Calls visit(texel, x, y) with each texel's place in the atlas: slice k starts at column k * size.x.
template <class Visit> void forEachTexel(const glm::ivec3& size, Visit&& visit)
{
    size_t texel = 0;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                visit(texel++, k * size.x + i, j);
            }
        }
    }
}

// Calls visit(texel, weight) with the eight texels around unit coordinates.
template <class Visit> void forEachCorner(const BrdfTable& table, const glm::vec3& unit, Visit&& visit)
{
    const glm::vec3 position = unit * (glm::vec3(table.size) - 1.0f);
    const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(position)), glm::ivec3(0), table.size - 1);
    const glm::ivec3 high = glm::min(low + 1, table.size - 1);
    const glm::vec3 t = position - glm::vec3(low);
    for (int corner = 0; corner < 8; ++corner) {
        const bool i = corner & 1, j = corner & 2, k = corner & 4;
        const float weight = (i ? t.x : 1 - t.x) * (j ? t.y : 1 - t.y) * (k ? t.z : 1 - t.z);
        visit(table.index(i ? high.x : low.x, j ? high.y : low.y, k ? high.z : low.z), weight);
    }
}

// Of `channels` channels, or up to so many more.
Image loadAtlas(const std::filesystem::path& file, const glm::ivec3& size, int channels, int more = 0)
{
    Image atlas = loadImage(file);
    if (atlas.width != size.x * size.z || atlas.height != size.y || atlas.channels < channels ||
        atlas.channels > channels + more) {
        throw Error(file, fmt::format("is {}x{} with {} channels", atlas.width, atlas.height, atlas.channels),
                    fmt::format("{}x{} with {}: slices of {}x{}", size.x * size.z, size.y, channels, size.x, size.y));
    }
    return atlas;
}

} // namespace

std::string nameOfCoordinates(int coordinates)
{
    return kCoordinateNames[static_cast<size_t>(coordinates)];
}

std::optional<int> coordinatesFromName(const std::string& name)
{
    const auto found = std::find(kCoordinateNames.begin(), kCoordinateNames.end(), name);
    return found == kCoordinateNames.end() ? std::nullopt
                                           : std::optional(static_cast<int>(found - kCoordinateNames.begin()));
}

std::string describeShape(const BrdfTable& table)
{
    return fmt::format("1 {} {} {} {} {:.9g}", table.size.x, table.size.y, table.size.z,
                       nameOfCoordinates(table.domain.coordinates), table.domain.thetaDMax);
}

LightView BrdfTable::directions(int i, int j, int k) const
{
    const glm::vec3 last = glm::max(glm::vec3(size) - 1.0f, glm::vec3(1.0f));
    return directionsFromUnit(domain, glm::vec3(i, j, k) / last);
}

BrdfValue sampleTable(const BrdfTable& table, const glm::vec3& unit)
{
    BrdfValue sum{glm::vec3(0), 0};
    forEachCorner(table, unit, [&](size_t texel, float weight) {
        sum.value += weight * table.values[texel];
        sum.confidence += weight * table.confidence[texel];
    });
    return sum;
}

float expectedError(const BrdfTable& table, size_t texel)
{
    return table.error.empty() ? errorFromCoverage(table.confidence[texel]) : table.error[texel];
}

float sampleError(const BrdfTable& table, const glm::vec3& unit)
{
    float sum = 0;
    forEachCorner(table, unit, [&](size_t texel, float weight) { sum += weight * expectedError(table, texel); });
    return sum;
}

BrdfValue evaluateTable(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v)
{
    return sampleTable(table, unitFromDirections(table.domain, n, l, v));
}

void saveBrdfTable(const std::filesystem::path& file, const BrdfTable& table)
{
    Image atlas(table.size.x * table.size.z, table.size.y, table.error.empty() ? 4 : 5);
    forEachTexel(table.size, [&](size_t texel, int x, int y) {
        atlas.setRgb(x, y, table.values[texel]);
        atlas.at(x, y, 3) = table.confidence[texel];
        if (!table.error.empty()) {
            atlas.at(x, y, 4) = table.error[texel];
        }
    });
    saveImage(file, atlas, PixelType::float32, {{kShapeAttribute, describeShape(table)}});
}

BrdfTable loadBrdfTable(const std::filesystem::path& file)
{
    BrdfTable table = tableOfShape(file, readImageAttribute(file, kShapeAttribute));
    const Image atlas = loadAtlas(file, table.size, 4, 1);
    table.error.resize(atlas.channels > 4 ? table.values.size() : 0);
    forEachTexel(table.size, [&](size_t texel, int x, int y) {
        table.values[texel] = atlas.rgb(x, y);
        table.confidence[texel] = atlas.at(x, y, 3);
        if (!table.error.empty()) {
            table.error[texel] = atlas.at(x, y, 4);
        }
    });
    return table;
}

void saveCoverage(const std::filesystem::path& file, const glm::ivec3& size, const Coverage& coverage)
{
    Image atlas(size.x * size.z, size.y, 2);
    forEachTexel(size, [&](size_t texel, int x, int y) {
        atlas.at(x, y, 0) = coverage.distance[texel];
        atlas.at(x, y, 1) = coverage.count[texel];
    });
    saveImage(file, atlas, PixelType::float32);
}

Coverage loadCoverage(const std::filesystem::path& file, const glm::ivec3& size)
{
    const Image atlas = loadAtlas(file, size, 2, 1);
    const size_t texels = static_cast<size_t>(size.x) * size.y * size.z;
    Coverage coverage{std::vector<float>(texels), std::vector<float>(texels)};
    forEachTexel(size, [&](size_t texel, int x, int y) {
        coverage.distance[texel] = atlas.at(x, y, 0);
        coverage.count[texel] = atlas.at(x, y, 1);
    });
    return coverage;
}

} // namespace nacre
