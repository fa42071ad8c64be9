#include "engine/gpu/device_info.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/gpu/check.h"
#include "engine/gpu/instance.h"

namespace nacre {
namespace {

// Best first.
constexpr std::array<const char*, 5> kTypes = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};

const char* typeName(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return kTypes[0];
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return kTypes[1];
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return kTypes[2];
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return kTypes[3];
    default:
        return kTypes[4];
    }
}

bool hasExtension(VkPhysicalDevice device, const char* name)
{
    uint32_t count = 0;
    checkVulkan(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
                "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    checkVulkan(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
                "vkEnumerateDeviceExtensionProperties");
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

// Radiance is added up, and tables are filtered, in this format; both are optional for it in Vulkan.
bool floatFormatSuffices(VkPhysicalDevice device)
{
    constexpr VkFormatFeatureFlags kNeeded =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device, VK_FORMAT_R32G32B32A32_SFLOAT, &properties);
    return (properties.optimalTilingFeatures & kNeeded) == kNeeded;
}

std::string missingFrom(VkPhysicalDevice device, uint32_t apiVersion)
{
    if (apiVersion < VK_API_VERSION_1_3) {
        return "Vulkan 1.3";
    }
    DeviceFeatures features;
    vkGetPhysicalDeviceFeatures2(device, &features.core);
    std::vector<const char*> missing;
    const auto need = [&](bool there, const char* what) {
        if (!there) {
            missing.push_back(what);
        }
    };
    need(features.vulkan13.dynamicRendering, "dynamicRendering");
    need(features.vulkan13.synchronization2, "synchronization2");
    need(features.vulkan13.maintenance4, "maintenance4");
    need(features.vulkan12.scalarBlockLayout, "scalarBlockLayout");
    need(hasExtension(device, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME), VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    need(graphicsQueueFamily(device).has_value(), "a graphics queue");
    need(floatFormatSuffices(device), "blending and linear filtering of R32G32B32A32_SFLOAT");
    return fmt::format("{}", fmt::join(missing, ", "));
}

std::string limitsOf(VkPhysicalDevice device, const VkPhysicalDeviceLimits& limits)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    VkDeviceSize own = 0;
    bool isShared = false; // the host sees all of it
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        constexpr VkMemoryPropertyFlags kOwn = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        if ((memory.memoryTypes[i].propertyFlags & kOwn) != 0) {
            const VkDeviceSize size = memory.memoryHeaps[memory.memoryTypes[i].heapIndex].size;
            const bool isSeen = (memory.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
            isShared = size > own ? isSeen : isShared || (size == own && isSeen);
            own = std::max(own, size);
        }
    }
    return fmt::format("pictures to {}, {} bits of filter, {:.1f} GiB of memory{}, {} push constant bytes",
                       limits.maxImageDimension2D, limits.subTexelPrecisionBits,
                       static_cast<double>(own) / (1ull << 30), isShared ? " that the host sees" : "",
                       limits.maxPushConstantsSize);
}

std::string numberedNames(const std::vector<DeviceInfo>& devices)
{
    std::vector<std::string> names;
    for (size_t i = 0; i < devices.size(); ++i) {
        names.push_back(fmt::format("{} = {}", i, devices[i].name));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

size_t bestDevice(const std::vector<DeviceInfo>& devices)
{
    const auto rank = [&](const DeviceInfo& device) {
        const auto type = std::find(kTypes.begin(), kTypes.end(), device.type) - kTypes.begin();
        return std::pair(!device.missing.empty(), type);
    };
    const auto best = std::min_element(devices.begin(), devices.end(),
                                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return static_cast<size_t>(best - devices.begin());
}

size_t selectedDevice(const std::vector<DeviceInfo>& devices, const std::string& selector)
{
    size_t number = devices.size();
    const char* end = selector.data() + selector.size();
    if (const auto parsed = std::from_chars(selector.data(), end, number); parsed.ptr != end) {
        const auto named = std::find_if(devices.begin(), devices.end(), [&](const auto& d) {
            return lowerCase(d.name).find(lowerCase(selector)) != std::string::npos;
        });
        number = static_cast<size_t>(named - devices.begin());
    }
    if (number >= devices.size()) {
        throw Error({}, fmt::format("no Vulkan device '{}'", selector),
                    fmt::format("a number or part of a name of: {}", numberedNames(devices)), Error::kUsage);
    }
    return number;
}

} // namespace

DeviceFeatures::DeviceFeatures()
{
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.pNext = &vulkan13;
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core.pNext = &vulkan12;
}

std::optional<uint32_t> graphicsQueueFamily(VkPhysicalDevice device)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) {
            return i;
        }
    }
    return std::nullopt;
}

DeviceInfo describeDevice(VkPhysicalDevice device)
{
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
    vkGetPhysicalDeviceProperties2(device, &properties);
    const uint32_t version = properties.properties.apiVersion;
    return {.name = properties.properties.deviceName,
            .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
            .type = typeName(properties.properties.deviceType),
            .apiVersion = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                                      VK_API_VERSION_PATCH(version)),
            .limits = limitsOf(device, properties.properties.limits),
            .missing = missingFrom(device, version)};
}

std::vector<DeviceInfo> listDevices()
{
    const Instance instance;
    std::vector<DeviceInfo> devices;
    for (VkPhysicalDevice device : instance.physicalDevices()) {
        devices.push_back(describeDevice(device));
    }
    return devices;
}

std::string deviceOfEnvironment()
{
    const char* value = std::getenv("NACRE_DEVICE");
    return value != nullptr ? value : "";
}

size_t chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& selector)
{
    if (devices.empty()) {
        throw Error({}, "no Vulkan device", "install a driver, e.g. mesa-vulkan-drivers");
    }
    const size_t index = selector.empty() ? bestDevice(devices) : selectedDevice(devices, selector);
    if (!devices[index].missing.empty()) {
        throw Error({}, fmt::format("Vulkan device {} lacks {}", devices[index].name, devices[index].missing),
                    "a device that has it, see nacre info");
    }
    return index;
}

} // namespace nacre
