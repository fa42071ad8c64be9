#include "acquisition/brdf/albedo_factor.h"

#include <gtest/gtest.h>

namespace nacre {

namespace {

// Of ten pixels one without a factor, and two in a hollow that reddens what it shows.
Image factorsOfHollow()
{
    Image albedo(10, 1, 3);
    for (size_t i = 1; i < 10; ++i) {
        albedo.values[3 * i] = i < 3 ? 0.8f : 0.4f;
        albedo.values[3 * i + 1] = i < 3 ? 0.3f : 0.2f;
        albedo.values[3 * i + 2] = 0.1f;
    }
    return albedo;
}

BrdfTable tableOfTwo()
{
    BrdfTable table;
    table.values = {{1, 2, 3}, {4, 5, 6}};
    return table;
}

} // namespace

TEST(AlbedoFactor, WhatThePixelsLoseTheTableGets)
{
    for (const bool haveOneAlbedo : {false, true}) {
        const Image before = factorsOfHollow();
        Image albedo = before;
        BrdfTable table = tableOfTwo();
        const glm::vec3 taken = normaliseAlbedo(haveOneAlbedo, albedo, table);
        for (size_t i = 0; i < albedo.values.size(); ++i) {
            const int c = static_cast<int>(i % 3);
            EXPECT_NEAR(albedo.values[i] * table.values[1][c], before.values[i] * tableOfTwo().values[1][c], 1e-6f);
            EXPECT_NEAR(table.values[0][c], taken[c] * tableOfTwo().values[0][c], 1e-6f);
        }
    }
}

TEST(AlbedoFactor, HollowsDoNotColourAMaterialOfOneAlbedo)
{
    Image albedo = factorsOfHollow(), painted = factorsOfHollow();
    BrdfTable table = tableOfTwo(), paintedTable = tableOfTwo();
    const glm::vec3 taken = normaliseAlbedo(true, albedo, table);
    EXPECT_NEAR(taken.r, 0.4f, 1e-6f);
    EXPECT_NEAR(taken.g, 0.2f, 1e-6f);
    EXPECT_NEAR(taken.b, 0.1f, 1e-6f);
    EXPECT_NEAR(normaliseAlbedo(false, painted, paintedTable).r, (2 * 0.8f + 7 * 0.4f) / 9, 1e-6f);
}

} // namespace nacre
