// Plays a device that is lost: preloaded, its vkWaitForFences stands in front of the loader's. After as many waits as
// NACRE_WAITS_BEFORE_LOSS says it answers VK_ERROR_DEVICE_LOST, once the device has in truth finished.
#include <atomic>
#include <cstdlib>

#include <dlfcn.h>
#include <vulkan/vulkan.h>

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkWaitForFences(VkDevice device, uint32_t count, const VkFence* fences,
                                                          VkBool32 all, uint64_t timeout)
{
    static const auto loaders = reinterpret_cast<PFN_vkWaitForFences>(dlsym(RTLD_NEXT, "vkWaitForFences"));
    static std::atomic<int> waits = 0;
    const VkResult result = loaders(device, count, fences, all, timeout);
    const char* before = std::getenv("NACRE_WAITS_BEFORE_LOSS");
    return before != nullptr && waits++ >= std::atoi(before) ? VK_ERROR_DEVICE_LOST : result;
}
