#pragma once
#include <vulkan/vulkan.h>

namespace nacre {

// Throws Error (data) with the call's name and the result's name unless the call succeeded.
void checkVulkan(VkResult result, const char* call);

} // namespace nacre
