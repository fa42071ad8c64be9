#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include "engine/view_state/key_table.h"

struct GLFWwindow;

namespace nacre {

// What has happened since it was last asked for. Positions are in framebuffer pixels, y down.
struct WindowEvents {
    std::vector<KeyPress> keys;
    std::vector<std::filesystem::path> dropped;
    float wheel = 0;                  // steps, positive away from the user
    bool pressed[2] = {false, false}; // left, right
    bool released[2] = {false, false};
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
    bool isHeld(int button) const;      // 0 left, 1 right
    bool shouldClose() const;
    void setTitle(const std::string& title);

    // Returns what has happened, at once, or when something does; seconds < 0: however long that takes.
    WindowEvents waitForEvents(double seconds);
    // Wakes waitForEvents; from any thread.
    static void wake();

    WindowEvents pending; // filled by the callbacks

private:
    GLFWwindow* window_ = nullptr;
};

} // namespace nacre
