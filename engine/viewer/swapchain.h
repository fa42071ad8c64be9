#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "engine/gpu/context.h"
#include "engine/viewer/window.h"

namespace nacre {

// The pictures that a window shows in turn. Nothing is drawn while the window has no size.
class Swapchain {
public:
    // Throws Error where the device cannot present in this window.
    Swapchain(const Context& context, const Window& window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    // Follows the window's size. Lavapipe never says that a swapchain is out of date, so it is told.
    void rebuild();
    bool isEmpty() const { return extent_.width == 0; }

    VkFormat format() const { return format_; }
    VkExtent2D extent() const { return extent_; }
    size_t imageCount() const { return images_.size(); }
    VkImage image(size_t i) const { return images_[i]; }
    VkImageView view(size_t i) const { return views_[i].get(); }
    size_t generation() const { return generation_; } // counts rebuilds

    // Records into the next image (which is to end in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR) and shows it. False where the
    // swapchain has to be rebuilt first.
    bool show(const std::function<void(VkCommandBuffer, size_t image)>& record);

private:
    void clear();
    void makeSurface();
    bool mustRebuild(VkResult result, const char* call);

    const Context& context_;
    const Window& window_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkExtent2D extent_{0, 0};
    std::vector<VkImage> images_;
    std::vector<Owned<VkImageView, vkDestroyImageView>> views_;
    Owned<VkSemaphore, vkDestroySemaphore> acquired_;
    std::vector<Owned<VkSemaphore, vkDestroySemaphore>> drawn_; // one an image
    size_t generation_ = 0;
};

} // namespace nacre
