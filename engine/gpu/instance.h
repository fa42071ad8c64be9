#pragma once
#include <atomic>
#include <vector>

#include <vulkan/vulkan.h>

namespace nacre {

// The connection to the Vulkan loader. Where no driver is installed it is empty and has no devices. Validation with
// synchronization checks is loaded when the build asks for it (NACRE_VALIDATION) or the environment says
// NACRE_VALIDATION=1.
class Instance {
public:
    Instance();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

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
