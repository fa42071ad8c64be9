#include "engine/gpu/check.h"

#include <string>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {
namespace {

std::string resultName(VkResult result)
{
#define NACRE_RESULT(name)                                                                                             \
    case name:                                                                                                         \
        return #name
    switch (result) {
        NACRE_RESULT(VK_NOT_READY);
        NACRE_RESULT(VK_TIMEOUT);
        NACRE_RESULT(VK_INCOMPLETE);
        NACRE_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY);
        NACRE_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        NACRE_RESULT(VK_ERROR_INITIALIZATION_FAILED);
        NACRE_RESULT(VK_ERROR_DEVICE_LOST);
        NACRE_RESULT(VK_ERROR_MEMORY_MAP_FAILED);
        NACRE_RESULT(VK_ERROR_LAYER_NOT_PRESENT);
        NACRE_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT);
        NACRE_RESULT(VK_ERROR_FEATURE_NOT_PRESENT);
        NACRE_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER);
        NACRE_RESULT(VK_ERROR_TOO_MANY_OBJECTS);
        NACRE_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED);
    default:
        return fmt::format("VkResult {}", static_cast<int>(result));
    }
#undef NACRE_RESULT
}

} // namespace

void checkVulkan(VkResult result, const char* call)
{
    if (result == VK_ERROR_DEVICE_LOST) {
        throw Error({}, fmt::format("the Vulkan device was lost: {} answered {}", call, resultName(result)),
                    "a frame that its driver survives: a smaller picture, fewer lights, or another device");
    }
    if (result != VK_SUCCESS) {
        throw Error({}, fmt::format("{} answered {}", call, resultName(result)), "expected VK_SUCCESS");
    }
}

} // namespace nacre
