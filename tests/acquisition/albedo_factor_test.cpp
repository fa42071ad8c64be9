#include "acquisition/brdf/albedo_factor.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "acquisition/chain/material_albedo.h"

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

// Pixels of one material get one factor; black ones, ones without a normal, and those of another material keep theirs.
TEST(AlbedoFactor, PixelsThatShareAnAlbedoGetTheMedian)
{
    Image albedo = factorsOfHollow();
    NormalMap normals(10, 1);
    std::fill(normals.confidence.begin(), normals.confidence.end(), 1.0f);
    normals.confidence[1] = 0;
    std::vector<uint8_t> labels(10, 0);
    labels[2] = 1;
    shareAlbedos(normals, labels, std::vector<uint8_t>{1, 0}, albedo);
    EXPECT_EQ(albedo.rgb(0, 0), glm::vec3(0));
    EXPECT_EQ(albedo.rgb(1, 0), factorsOfHollow().rgb(1, 0));
    EXPECT_EQ(albedo.rgb(2, 0), factorsOfHollow().rgb(2, 0));
    albedo = factorsOfHollow();
    labels[2] = 0;
    shareAlbedos(normals, labels, std::vector<uint8_t>{1, 0}, albedo);
    for (int x = 2; x < 10; ++x) {
        EXPECT_EQ(albedo.rgb(x, 0), glm::vec3(0.4f, 0.2f, 0.1f)) << x;
    }
}

} // namespace nacre
