#pragma once
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "engine/files/measures.h"

namespace nacre::test {

// A picture against the one that was looked at and kept.
struct GoldenFigures {
    CodeDifference codes; // beyond the tolerance
    double structuralSimilarity = 0;

    bool pass() const;
    std::string text() const; // one line
};

// Both of one size.
GoldenFigures goldenFigures(const Image& actual, const Image& golden);

// Why a picture would guard nothing: of one colour, mostly black, mostly clipped. Empty where it will do.
std::string whyNoGuard(const Image& picture);

// Where the golden lies, and the folder that is given actual.png, golden.png, difference.png (16 times as bright) and
// figures.txt on failure.
struct GoldenFiles {
    std::filesystem::path golden;
    std::filesystem::path evidence;
};

// A golden that is missing, of another size, or guards nothing is a failure too.
testing::AssertionResult matchesGolden(const std::filesystem::path& actual, const GoldenFiles& files);

// Puts the picture into the golden's place. The result is a failure always, and says by how much it changed: a run that
// blesses is not a test. A picture that would guard nothing is refused.
testing::AssertionResult blessGolden(const std::filesystem::path& actual, const GoldenFiles& files);

} // namespace nacre::test
