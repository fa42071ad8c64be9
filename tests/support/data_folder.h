#pragma once
#include <filesystem>

// Real captures lie beside the project and are not part of it: tests that need them say so and are skipped by name.
#define NACRE_REQUIRE_DATA(part)                                                                                       \
    if (!std::filesystem::exists(std::filesystem::path(NACRE_DATA_DIR) / (part))) {                                    \
        GTEST_SKIP() << "needs " << (part) << " in " << NACRE_DATA_DIR;                                                \
    }

inline std::filesystem::path dataFolder()
{
    return NACRE_DATA_DIR;
}
