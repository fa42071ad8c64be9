#include "engine/gpu/instance.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "engine/files/error.h"
#include "engine/gpu/check.h"

namespace nacre {
namespace {

bool validationIsWanted()
{
#ifdef NACRE_VALIDATION
    return true;
#else
    const char* value = std::getenv("NACRE_VALIDATION");
    return value != nullptr && std::string_view(value) == "1";
#endif
}

VkBool32 countMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                      const VkDebugUtilsMessengerCallbackDataEXT* data, void* count)
{
    ++*static_cast<std::atomic<int>*>(count);
    std::fprintf(stderr, "vulkan validation: %s\n", data->pMessage);
    return VK_FALSE;
}

// Called by its looked-up address: extensions of the instance are not exported by the loader.
template <typename Function> Function instanceFunction(VkInstance instance, const char* name)
{
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

// VK_NULL_HANDLE where the loader finds no driver at all.
VkInstance createInstance(const VkDebugUtilsMessengerCreateInfoEXT* messenger, std::span<const char* const> wanted)
{
    const VkApplicationInfo application{
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "nacre", .apiVersion = VK_API_VERSION_1_3};
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = messenger,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const bool validate = messenger != nullptr;
    std::vector<const char*> extensions(wanted.begin(), wanted.end());
    if (validate) {
        extensions.insert(extensions.end(),
                          {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME});
    }
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = validate ? &features : nullptr,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validate ? 1u : 0u,
                                    .ppEnabledLayerNames = &layer,
                                    .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        return VK_NULL_HANDLE;
    }
    if (validate && (result == VK_ERROR_LAYER_NOT_PRESENT || result == VK_ERROR_EXTENSION_NOT_PRESENT)) {
        throw Error({}, "the Vulkan validation layer is not installed",
                    "install it, e.g. vulkan-validationlayers, or do without NACRE_VALIDATION");
    }
    checkVulkan(result, "vkCreateInstance");
    return instance;
}

} // namespace

Instance::Instance(std::span<const char* const> extensions)
{
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = countMessage,
        .pUserData = &messages_};
    const bool validate = validationIsWanted();
    instance_ = createInstance(validate ? &messenger : nullptr, extensions);
    if (instance_ != VK_NULL_HANDLE && validate) {
        const auto create =
            instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
        checkVulkan(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }
}

Instance::~Instance()
{
    if (messenger_ != VK_NULL_HANDLE) {
        instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
            instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const
{
    if (instance_ == VK_NULL_HANDLE) {
        return {};
    }
    uint32_t count = 0;
    checkVulkan(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    checkVulkan(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

} // namespace nacre
