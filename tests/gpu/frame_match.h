#pragma once
#include <gtest/gtest.h>

#include "engine/scene/scene.h"

namespace nacre::test {

// The bound between the Vulkan frame and its CPU twin: radiance within 1e-3 of the value plus 1e-5 of the peak, the
// picture within 1/255. On failure both and their difference are left in the test's temporary folder as EXR.
// The first bound is 32 times as wide on a device whose filter has 8 bits of weight, which all but
// software's have.
testing::AssertionResult framesMatch(const Frame& actual, const Frame& expected);

} // namespace nacre::test
