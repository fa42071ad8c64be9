#pragma once
#include <atomic>
#include <span>
#include <vector>

#include <vulkan/vulkan.h>

namespace nacre {

// The connection to the Vulkan loader. Where no driver is installed it is empty and has no devices. Validation with
// synchronization checks is loaded when the build asks for it (NACRE_VALIDATION) or the environment says
// NACRE_VALIDATION=1. A window asks for `extensions` of its own.
class Instance {
public:
    explicit Instance(std::span<const char* const> extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance get() const { return instance_; }
    std::vector<VkPhysicalDevice> physicalDevices() const;
    bool validates() const { return messenger_ != VK_NULL_HANDLE; }
    // Warnings and errors of the validation layer so far; each was printed on stderr.
    int validationMessages() const { return messages_; }

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::atomic<int> messages_ = 0;
};

} // namespace nacre
