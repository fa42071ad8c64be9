#pragma once
#include <utility>

#include <vulkan/vulkan.h>

namespace nacre {

// Throws Error (data) with the call's name and the result's name unless the call succeeded.
void checkVulkan(VkResult result, const char* call);

// One object of a device and the call that destroys it; the device must live longer.
template <typename Handle, auto destroy> class Owned {
public:
    Owned() = default;
    Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    Owned(Owned&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, static_cast<Handle>(VK_NULL_HANDLE)))
    {
    }
    Owned& operator=(Owned&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE) {
            destroy(device_, handle_, nullptr);
        }
    }
    Handle get() const { return handle_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

// What a call of the form vkCreateX(parent, &info, nullptr, &x) makes. Throws Error as checkVulkan does.
template <typename Parent, typename Info, typename Handle>
Handle created(VkResult (*create)(Parent, const Info*, const VkAllocationCallbacks*, Handle*), const char* call,
               Parent parent, const Info& info)
{
    Handle handle = VK_NULL_HANDLE;
    checkVulkan(create(parent, &info, nullptr, &handle), call);
    return handle;
}

} // namespace nacre
