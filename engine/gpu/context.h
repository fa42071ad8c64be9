#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <vulkan/vulkan.h>

#include "engine/gpu/check.h"
#include "engine/gpu/device_info.h"
#include "engine/gpu/instance.h"

namespace nacre {

// One device with one queue. Everything made from it must be gone before it.
class Context {
public:
    // selector as --device has it: see chooseDevice. Throws Error where there is no Vulkan device. With the instance
    // extensions that a window asks for, the device can present as well.
    explicit Context(const std::string& selector = {}, std::span<const char* const> windowExtensions = {});

    VkInstance instance() const { return instance_.get(); }
    VkPhysicalDevice physicalDevice() const { return physicalDevice_; }
    VkDevice device() const { return device_.get(); }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queueFamily_; }
    const DeviceInfo& info() const { return info_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    // Of one buffer or texture.
    VkDeviceSize largestAllocation() const { return largestAllocation_; }
    bool validates() const { return instance_.validates(); }
    int validationMessages() const { return instance_.validationMessages(); }

    // Memory with the `required` properties, with the `preferred` ones too where there is such.
    Owned<VkDeviceMemory, vkFreeMemory> allocate(const VkMemoryRequirements& requirements,
                                                 VkMemoryPropertyFlags required,
                                                 VkMemoryPropertyFlags preferred = 0) const;

    // Records, submits, and returns when the device is done.
    void run(const std::function<void(VkCommandBuffer)>& record) const;
    // The same once `awaited` is signalled, signalling `done`.
    void run(const std::function<void(VkCommandBuffer)>& record, VkSemaphore awaited, VkSemaphore done) const;

    // VK_KHR_push_descriptor is not exported by the loader.
    PFN_vkCmdPushDescriptorSetKHR pushDescriptorSet = nullptr;

private:
    void submit(const std::function<void(VkCommandBuffer)>& record, VkSubmitInfo2 info) const;

    struct DestroyDevice {
        void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
    };
    using Device = std::unique_ptr<std::remove_pointer_t<VkDevice>, DestroyDevice>;

    Instance instance_;
    VkPhysicalDevice physicalDevice_;
    DeviceInfo info_;
    VkPhysicalDeviceLimits limits_{};
    VkDeviceSize largestAllocation_ = 0;
    VkPhysicalDeviceMemoryProperties memory_{};
    Device device_;
    uint32_t queueFamily_ = 0;
    VkQueue queue_ = VK_NULL_HANDLE;
    Owned<VkCommandPool, vkDestroyCommandPool> commandPool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; // of the pool
    Owned<VkFence, vkDestroyFence> done_;
};

} // namespace nacre
