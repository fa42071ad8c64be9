#pragma once
#include <gtest/gtest.h>

#include "engine/scene/scene.h"

namespace nacre::test {

// The bound between the Vulkan frame and its CPU twin: radiance within 1e-3 of the value plus 1e-5 of the peak, the
// picture within 1/255. On failure both and their difference are left in the test's temporary folder as EXR.
testing::AssertionResult framesMatch(const Frame& actual, const Frame& expected);

} // namespace nacre::test
