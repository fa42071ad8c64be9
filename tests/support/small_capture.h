#pragma once
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_nacre.h"
#include "tests/support/temp_folder.h"

namespace nacre {

// A sphere of 24 pixels under 14 given lights, as nacre synth writes it.
inline std::string makeSmallCapture(const TempFolder& folder)
{
    const std::string capture = (folder / "c").string();
    const ProgramRun made = runNacre({"synth", capture, "--shape", "sphere", "--side", "24", "--sphere-size", "48",
                                      "--lights", "14", "--give-lights"});
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return capture;
}

} // namespace nacre
