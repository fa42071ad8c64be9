#pragma once
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace nacre {

// One device as the user sees it.
struct DeviceInfo {
    std::string name;
    std::string driver;     // name and version
    std::string type;       // "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
    std::string apiVersion; // e.g. "1.3.230"
    std::string limits;     // of pictures, filters, memory; one line
    std::string missing;    // what the renderer needs and the device lacks; empty where it will do
};

// In the loader's order, which is what --device counts from 0; empty where there is none.
std::vector<DeviceInfo> listDevices();

DeviceInfo describeDevice(VkPhysicalDevice device);

// A queue family that draws; none where the device has no such queue.
std::optional<uint32_t> graphicsQueueFamily(VkPhysicalDevice device);

// The features that the renderer enables, chained for VkDeviceCreateInfo and for a query of what is there.
struct DeviceFeatures {
    VkPhysicalDeviceVulkan13Features vulkan13{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceFeatures2 core{}; // the chain's head

    DeviceFeatures();
    DeviceFeatures(const DeviceFeatures&) = delete;
    DeviceFeatures& operator=(const DeviceFeatures&) = delete;
};

// $NACRE_DEVICE, or empty.
std::string deviceOfEnvironment();

// Index of the device to use. Empty selector: the best that will do, discrete before integrated before the CPU. A
// number counts from 0; anything else is part of a name, any case. Throws Error: no device at all; nothing fits the
// selector (usage); what was chosen lacks something.
size_t chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& selector);

} // namespace nacre
