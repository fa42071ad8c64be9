#include "engine/gpu/context.h"

#include "engine/files/error.h"

namespace nacre {
namespace {

VkPhysicalDevice choosePhysicalDevice(const Instance& instance, const std::string& selector)
{
    const std::vector<VkPhysicalDevice> devices = instance.physicalDevices();
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice device : devices) {
        infos.push_back(describeDevice(device));
    }
    return devices[chooseDevice(infos, selector.empty() ? deviceOfEnvironment() : selector)];
}

VkDevice createDevice(VkPhysicalDevice physicalDevice, uint32_t queueFamily, bool presents)
{
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = queueFamily,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    DeviceFeatures features;
    features.vulkan13.dynamicRendering = VK_TRUE;
    features.vulkan13.synchronization2 = VK_TRUE;
    features.vulkan13.maintenance4 = VK_TRUE;
    features.vulkan12.scalarBlockLayout = VK_TRUE;
    const char* extensions[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME, VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = presents ? 2u : 1u,
                                  .ppEnabledExtensionNames = extensions};
    return created(vkCreateDevice, "vkCreateDevice", physicalDevice, info);
}

VkCommandPool createCommandPool(VkDevice device, uint32_t queueFamily)
{
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .queueFamilyIndex = queueFamily};
    return created(vkCreateCommandPool, "vkCreateCommandPool", device, info);
}

VkCommandBuffer allocateCommandBuffer(VkDevice device, VkCommandPool pool)
{
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    checkVulkan(vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
    return commands;
}

VkFence createFence(VkDevice device)
{
    const VkFenceCreateInfo info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    return created(vkCreateFence, "vkCreateFence", device, info);
}

} // namespace

Context::Context(const std::string& selector, std::span<const char* const> windowExtensions)
    : instance_(windowExtensions), physicalDevice_(choosePhysicalDevice(instance_, selector)),
      info_(describeDevice(physicalDevice_))
{
    VkPhysicalDeviceMaintenance3Properties allocation{.sType =
                                                          VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &allocation};
    vkGetPhysicalDeviceProperties2(physicalDevice_, &properties);
    limits_ = properties.properties.limits;
    largestAllocation_ = allocation.maxMemoryAllocationSize;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice_, &memory_);

    queueFamily_ = graphicsQueueFamily(physicalDevice_).value();
    device_.reset(createDevice(physicalDevice_, queueFamily_, !windowExtensions.empty()));
    vkGetDeviceQueue(device(), queueFamily_, 0, &queue_);
    commandPool_ = {device(), createCommandPool(device(), queueFamily_)};
    commands_ = allocateCommandBuffer(device(), commandPool_.get());
    done_ = {device(), createFence(device())};
    pushDescriptorSet =
        reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(vkGetDeviceProcAddr(device(), "vkCmdPushDescriptorSetKHR"));
}

Owned<VkDeviceMemory, vkFreeMemory> Context::allocate(const VkMemoryRequirements& requirements,
                                                      VkMemoryPropertyFlags required,
                                                      VkMemoryPropertyFlags preferred) const
{
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const bool allowed = (requirements.memoryTypeBits & (1u << i)) != 0;
            if (allowed && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) {
                const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                .allocationSize = requirements.size,
                                                .memoryTypeIndex = i};
                return {device(), created(vkAllocateMemory, "vkAllocateMemory", device(), info)};
            }
        }
    }
    throw Error({}, "the Vulkan device " + info_.name + " has no fitting memory type",
                "device memory, and memory that the host can map");
}

void Context::run(const std::function<void(VkCommandBuffer)>& record) const
{
    submit(record, {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2});
}

void Context::run(const std::function<void(VkCommandBuffer)>& record, VkSemaphore awaited, VkSemaphore done) const
{
    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = awaited,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = done,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    submit(record, {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                    .waitSemaphoreInfoCount = 1,
                    .pWaitSemaphoreInfos = &wait,
                    .signalSemaphoreInfoCount = 1,
                    .pSignalSemaphoreInfos = &signal});
}

void Context::submit(const std::function<void(VkCommandBuffer)>& record, VkSubmitInfo2 info) const
{
    checkVulkan(vkResetCommandPool(device(), commandPool_.get(), 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    checkVulkan(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    record(commands_);
    checkVulkan(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");

    const VkCommandBufferSubmitInfo commandsInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                                 .commandBuffer = commands_};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commandsInfo;
    VkFence fence = done_.get();
    checkVulkan(vkQueueSubmit2(queue_, 1, &info, fence), "vkQueueSubmit2");
    checkVulkan(vkWaitForFences(device(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    checkVulkan(vkResetFences(device(), 1, &fence), "vkResetFences");
}

} // namespace nacre
