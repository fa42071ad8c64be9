#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_nacre.h"

namespace nacre {

// One line on stderr that has all fragments, and the exit code.
inline void expectOneLine(const ProgramRun& run, int exitCode, const std::vector<std::string>& fragments)
{
    EXPECT_EQ(run.exitCode, exitCode) << run.err;
    EXPECT_EQ(run.err.rfind("nacre: ", 0), 0u) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    for (const std::string& fragment : fragments) {
        EXPECT_NE(run.err.find(fragment), std::string::npos) << "\"" << fragment << "\" is not in: " << run.err;
    }
}

} // namespace nacre
