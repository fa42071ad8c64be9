#pragma once
#include <vector>

#include "engine/viewer/window.h"

namespace nacre {

// Dear ImGui drawn over what a swapchain's image holds already. Its version 1.86 draws no textures but its font:
// pictures among the panels are copied below it (see placed_picture.h).
class UiPass {
public:
    // `scale` of sizes in pixels: 1 at 96 dots an inch.
    UiPass(const Context& context, const Window& window, const Swapchain& swapchain, float scale);
    ~UiPass();
    UiPass(const UiPass&) = delete;
    UiPass& operator=(const UiPass&) = delete;

    // Between these, ImGui's functions describe the next frame.
    void begin();
    void end();

    // The image must be in VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL; it ends in the one for presenting.
    void record(VkCommandBuffer commands, const Swapchain& swapchain, size_t image);

    float scale() const { return scale_; }

private:
    void makeFramebuffers(const Swapchain& swapchain);

    const Context& context_;
    float scale_ = 1;
    Owned<VkRenderPass, vkDestroyRenderPass> renderPass_;
    Owned<VkDescriptorPool, vkDestroyDescriptorPool> descriptors_;
    std::vector<Owned<VkFramebuffer, vkDestroyFramebuffer>> framebuffers_; // of the swapchain's generation
    size_t generation_ = 0;
};

} // namespace nacre
