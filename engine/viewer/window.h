#pragma once
struct GLFWwindow;
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/view_state/key_table.h"

namespace nacre {

inline constexpr int kButtons = 3; // of the mouse: left, right, middle

// What has happened since it was last asked for. Positions are in framebuffer pixels, y down.
struct WindowEvents {
    std::vector<KeyPress> keys;
    std::vector<std::filesystem::path> dropped;
    float wheel = 0;             // steps, positive away from the user
    bool pressed[kButtons] = {}; // left, right, middle
    bool released[kButtons] = {};
    glm::vec2 pressedAt{0, 0};  // the last of them: the cursor may have gone on since
    glm::vec2 releasedAt{0, 0}; // likewise
    bool doubleClicked = false; // left
    bool resized = false;
    bool any = false; // these, a cursor that moved, a window that was uncovered
};

// A window of the desktop. Throws Error where there is no display. One at a time.
class Window {
public:
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Instance extensions that surfaceFor needs; the display must be there. Throws Error.
    static std::vector<const char*> vulkanExtensions();
    VkSurfaceKHR surfaceFor(VkInstance instance) const;

    GLFWwindow* get() const { return window_; }
    glm::ivec2 framebufferSize() const; // 0 where minimised
    float contentScale() const;         // of the screen: 2 where 192 dots an inch
    glm::vec2 cursor() const;           // framebuffer pixels
    glm::vec2 density() const;          // framebuffer pixels a unit of the desktop
    bool isHeld(int button) const;      // 0 left, 1 right, 2 middle
    bool isShiftHeld() const;
    bool shouldClose() const;
    void setTitle(const std::string& title);

    // Returns what has happened, at once, or when something does; seconds < 0: however long that takes.
    WindowEvents waitForEvents(double seconds);
    // Wakes waitForEvents; from any thread.
    static void wake();

    WindowEvents pending;           // filled by the callbacks
    glm::vec2 cursorOfEvents{0, 0}; // framebuffer pixels

private:
    GLFWwindow* window_ = nullptr;
};

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

    // Copies to the next image (which is to end in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR) and shows it. False where the
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
    Owned<VkSemaphore, vkDestroySemaphore> acquired_;
    std::vector<Owned<VkSemaphore, vkDestroySemaphore>> drawn_; // one an image
};

} // namespace nacre
