#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "acquisition/brdf/light_slices.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

BrdfTable roughTable(int coordinates)
{
    BrdfTable table({9, 5, 7}, {coordinates, 0.6f});
    for (size_t i = 0; i < table.values.size(); ++i) {
        const auto random = [&](uint64_t channel) { return static_cast<float>(unitFromHash(hashOf(i, channel))); };
        table.values[i] = {random(0), random(1), random(2)};
    }
    return table;
}

// The camera's own direction and one beyond the table's largest thetaD among them.
std::vector<Light> manyLights()
{
    std::vector<Light> lights{{{0, 0, 1}, glm::vec3(1)}, {{0.999f, 0, 0.0447f}, glm::vec3(1)}};
    for (int i = 0; i < 11; ++i) {
        const auto angle = static_cast<float>(i);
        lights.push_back(
            {glm::normalize(glm::vec3(std::cos(angle), std::sin(angle), 0.9f + 0.2f * angle)), glm::vec3(1)});
    }
    return lights;
}

TEST(LightSlices, SayWhatTheTableSays)
{
    const std::vector<Light> lights = manyLights();
    std::vector<glm::vec3> values(lights.size());
    for (const int coordinates : {kHalfDifference, kOneWay}) {
        const BrdfTable table = roughTable(coordinates);
        const LightSlices slices(table, lights);
        size_t compared = 0;
        for (int y = -9; y <= 9; ++y) {
            for (int x = -9; x <= 9; ++x) {
                const glm::vec3 normal = glm::normalize(glm::vec3(0.1f * x, 0.1f * y, 0.5f));
                slices.evaluate(normal, values);
                for (size_t i = 0; i < lights.size(); ++i) {
                    if (glm::dot(normal, lights[i].direction) > 0) {
                        const glm::vec3 expected = evaluateTable(table, normal, lights[i].direction, {0, 0, 1}).value;
                        EXPECT_LT(glm::length(values[i] - expected), 2e-4f) << x << ", " << y << ", light " << i;
                        ++compared;
                    }
                }
            }
        }
        EXPECT_GT(compared, 2000u);
    }
}

} // namespace
} // namespace nacre
