#include "engine/viewer/window.h"

#include <cmath>
#include <utility>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include "engine/files/error.h"
#include "engine/gpu/check.h"

namespace nacre {

namespace {

static_assert(kKeyEscape == GLFW_KEY_ESCAPE && kKeyF12 == GLFW_KEY_F12 && GLFW_KEY_A == 'A');

constexpr double kDoubleClickSeconds = 0.35;
constexpr double kDoubleClickPixels = 4;

WindowEvents& eventsOf(GLFWwindow* window)
{
    WindowEvents& events = static_cast<Window*>(glfwGetWindowUserPointer(window))->pending;
    events.any = true;
    return events;
}

void onKey(GLFWwindow* window, int key, int, int action, int modifiers)
{
    WindowEvents& events = eventsOf(window);
    if (action != GLFW_RELEASE) {
        events.keys.push_back({.key = key,
                               .shift = (modifiers & GLFW_MOD_SHIFT) != 0,
                               .control = (modifiers & GLFW_MOD_CONTROL) != 0,
                               .isRepeat = action == GLFW_REPEAT});
    }
}

void onButton(GLFWwindow* window, int button, int action, int)
{
    static double lastTime = -1, lastX = 0, lastY = 0;
    WindowEvents& events = eventsOf(window);
    if (button > 1) {
        return;
    }
    (action == GLFW_PRESS ? events.pressed : events.released)[button] = true;
    if (button == 0 && action == GLFW_PRESS) {
        double x = 0, y = 0;
        glfwGetCursorPos(window, &x, &y);
        const double time = glfwGetTime();
        const bool isNear = std::abs(x - lastX) < kDoubleClickPixels && std::abs(y - lastY) < kDoubleClickPixels;
        events.doubleClicked = lastTime >= 0 && time - lastTime < kDoubleClickSeconds && isNear;
        lastTime = events.doubleClicked ? -1 : time;
        lastX = x;
        lastY = y;
    }
}

void onDrop(GLFWwindow* window, int count, const char** paths)
{
    WindowEvents& events = eventsOf(window);
    events.dropped.insert(events.dropped.end(), paths, paths + count);
}

void installCallbacks(GLFWwindow* window)
{
    glfwSetKeyCallback(window, onKey);
    glfwSetMouseButtonCallback(window, onButton);
    glfwSetDropCallback(window, onDrop);
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { eventsOf(w).wheel += static_cast<float>(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { eventsOf(w); });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { eventsOf(w); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { eventsOf(w); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { eventsOf(w); });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { eventsOf(w).resized = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { eventsOf(w).resized = true; });
}

std::string lastProblem()
{
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "GLFW does not say why";
}

void requireDisplay()
{
    if (glfwInit() != GLFW_TRUE) {
        throw Error({}, "there is no display for a window (" + lastProblem() + ")", "a graphical session");
    }
}

} // namespace

Window::Window(const std::string& title, int width, int height)
{
    requireDisplay();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string problem = lastProblem();
        glfwTerminate();
        throw Error({}, "no window can be opened (" + problem + ")", "a graphical session");
    }
    glfwSetWindowUserPointer(window_, this);
    installCallbacks(window_);
}

Window::~Window()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<const char*> Window::vulkanExtensions()
{
    requireDisplay();
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        throw Error({}, "Vulkan cannot draw into windows here", "a driver that can");
    }
    return {names, names + count};
}

VkSurfaceKHR Window::surfaceFor(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    checkVulkan(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "glfwCreateWindowSurface");
    return surface;
}

glm::ivec2 Window::framebufferSize() const
{
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) ? glm::ivec2(0) : size;
}

float Window::contentScale() const
{
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x;
}

glm::vec2 Window::cursor() const
{
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    glm::ivec2 size(1), framebuffer(1);
    glfwGetWindowSize(window_, &size.x, &size.y);
    glfwGetFramebufferSize(window_, &framebuffer.x, &framebuffer.y);
    const glm::vec2 density(size.x > 0 ? static_cast<float>(framebuffer.x) / static_cast<float>(size.x) : 1.0f,
                            size.y > 0 ? static_cast<float>(framebuffer.y) / static_cast<float>(size.y) : 1.0f);
    return glm::vec2(x, y) * density;
}

bool Window::isHeld(int button) const
{
    return glfwGetMouseButton(window_, button) == GLFW_PRESS;
}

bool Window::shouldClose() const
{
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(window_, title.c_str());
}

WindowEvents Window::waitForEvents(double seconds)
{
    if (seconds < 0) {
        glfwWaitEvents();
    } else if (seconds == 0) {
        glfwPollEvents();
    } else {
        glfwWaitEventsTimeout(seconds);
    }
    return std::exchange(pending, {});
}

void Window::wake()
{
    glfwPostEmptyEvent();
}

} // namespace nacre
