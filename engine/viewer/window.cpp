#include "engine/viewer/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/gpu/check.h"
#include "engine/gpu/texture.h"

namespace nacre {
namespace {

static_assert(GLFW_MOUSE_BUTTON_LEFT == 0 && GLFW_MOUSE_BUTTON_RIGHT == 1 && GLFW_MOUSE_BUTTON_MIDDLE == 2);
static_assert(kKeyEscape == GLFW_KEY_ESCAPE && kKeyEnter == GLFW_KEY_ENTER && kKeyF12 == GLFW_KEY_F12 &&
              GLFW_KEY_A == 'A');

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
    if (button >= kButtons) {
        return;
    }
    (action == GLFW_PRESS ? events.pressed : events.released)[button] = true;
    (action == GLFW_PRESS ? events.pressedAt : events.releasedAt) =
        static_cast<Window*>(glfwGetWindowUserPointer(window))->cursorOfEvents;
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

void onCursor(GLFWwindow* window, double x, double y)
{
    Window& owner = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    owner.cursorOfEvents = owner.density() * glm::vec2(x, y);
    eventsOf(window);
}

void installCallbacks(GLFWwindow* window)
{
    glfwSetKeyCallback(window, onKey);
    glfwSetMouseButtonCallback(window, onButton);
    glfwSetDropCallback(window, onDrop);
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { eventsOf(w).wheel += static_cast<float>(y); });
    glfwSetCursorPosCallback(window, onCursor);
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

VkSurfaceCapabilitiesKHR capabilitiesOf(VkPhysicalDevice device, VkSurfaceKHR surface)
{
    VkSurfaceCapabilitiesKHR capabilities;
    checkVulkan(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device, surface, &capabilities),
                "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    return capabilities;
}

// One without a curve of its own: what is drawn are the display's codes already.
VkSurfaceFormatKHR plainFormat(VkPhysicalDevice device, VkSurfaceKHR surface)
{
    uint32_t count = 0;
    checkVulkan(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), "surface formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    checkVulkan(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()), "surface formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        const auto found =
            std::find_if(formats.begin(), formats.end(), [&](const auto& f) { return f.format == wanted; });
        if (found != formats.end()) {
            return *found;
        }
    }
    const GLFWvidmode* mode = glfwGetPrimaryMonitor() ? glfwGetVideoMode(glfwGetPrimaryMonitor()) : nullptr;
    const bool isOther = mode && (mode->redBits != 8 || mode->greenBits != 8 || mode->blueBits != 8);
    throw Error({},
                isOther ? fmt::format("the screen has {} + {} + {} bits of red, green and blue", mode->redBits,
                                      mode->greenBits, mode->blueBits)
                        : "the Vulkan device cannot show 8-bit codes in a window",
                isOther ? "a screen of 24 bits: 8 each" : "another device");
}

Owned<VkSemaphore, vkDestroySemaphore> makeSemaphore(VkDevice device)
{
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    return {device, created(vkCreateSemaphore, "vkCreateSemaphore", device, info)};
}

VkExtent2D extentFor(const VkSurfaceCapabilitiesKHR& capabilities, const glm::ivec2& framebuffer)
{
    if (framebuffer.x <= 0 || framebuffer.y <= 0 || capabilities.maxImageExtent.width == 0) {
        return {0, 0};
    }
    constexpr uint32_t kUndecided = 0xFFFFFFFF; // the swapchain sets the window's size
    if (capabilities.currentExtent.width != kUndecided) {
        return capabilities.currentExtent;
    }
    return {std::clamp(static_cast<uint32_t>(framebuffer.x), capabilities.minImageExtent.width,
                       capabilities.maxImageExtent.width),
            std::clamp(static_cast<uint32_t>(framebuffer.y), capabilities.minImageExtent.height,
                       capabilities.maxImageExtent.height)};
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
    return glm::vec2(x, y) * density();
}

glm::vec2 Window::density() const
{
    glm::ivec2 size(1), framebuffer(1);
    glfwGetWindowSize(window_, &size.x, &size.y);
    glfwGetFramebufferSize(window_, &framebuffer.x, &framebuffer.y);
    return glm::vec2(size.x > 0 ? static_cast<float>(framebuffer.x) / static_cast<float>(size.x) : 1.0f,
                     size.y > 0 ? static_cast<float>(framebuffer.y) / static_cast<float>(size.y) : 1.0f);
}

bool Window::isHeld(int button) const
{
    return glfwGetMouseButton(window_, button) == GLFW_PRESS;
}

bool Window::isShiftHeld() const
{
    return glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
           glfwGetKey(window_, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
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

Swapchain::Swapchain(const Context& context, const Window& window)
    : context_(context), window_(window), acquired_(makeSemaphore(context.device()))
{
    makeSurface();
    format_ = plainFormat(context.physicalDevice(), surface_).format;
    rebuild();
}

Swapchain::~Swapchain()
{
    clear();
    vkDestroySurfaceKHR(context_.instance(), surface_, nullptr);
}

void Swapchain::makeSurface()
{
    surface_ = window_.surfaceFor(context_.instance());
    VkBool32 presents = VK_FALSE;
    checkVulkan(
        vkGetPhysicalDeviceSurfaceSupportKHR(context_.physicalDevice(), context_.queueFamily(), surface_, &presents),
        "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (!presents) {
        vkDestroySurfaceKHR(context_.instance(), surface_, nullptr);
        throw Error({}, "the Vulkan device " + context_.info().name + " cannot draw in this window", "another device");
    }
}

void Swapchain::clear()
{
    checkVulkan(vkDeviceWaitIdle(context_.device()), "vkDeviceWaitIdle");
    drawn_.clear();
    images_.clear();
    if (swapchain_ != VK_NULL_HANDLE) {
        vkDestroySwapchainKHR(context_.device(), swapchain_, nullptr);
        swapchain_ = VK_NULL_HANDLE;
    }
    extent_ = {0, 0};
}

void Swapchain::rebuild()
{
    clear();
    const VkSurfaceCapabilitiesKHR capabilities = capabilitiesOf(context_.physicalDevice(), surface_);
    extent_ = extentFor(capabilities, window_.framebufferSize());
    if (isEmpty()) {
        return;
    }
    const uint32_t most = capabilities.maxImageCount == 0 ? UINT32_MAX : capabilities.maxImageCount;
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = surface_,
                                        .minImageCount = std::min(capabilities.minImageCount + 1, most),
                                        .imageFormat = format_,
                                        .imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR,
                                        .imageExtent = extent_,
                                        .imageArrayLayers = 1,
                                        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                        .preTransform = capabilities.currentTransform,
                                        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
                                        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                        .clipped = VK_TRUE};
    swapchain_ = created(vkCreateSwapchainKHR, "vkCreateSwapchainKHR", context_.device(), info);
    uint32_t count = 0;
    checkVulkan(vkGetSwapchainImagesKHR(context_.device(), swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
    images_.resize(count);
    checkVulkan(vkGetSwapchainImagesKHR(context_.device(), swapchain_, &count, images_.data()),
                "vkGetSwapchainImagesKHR");
    while (drawn_.size() < images_.size()) {
        drawn_.push_back(makeSemaphore(context_.device()));
    }
}

bool Swapchain::mustRebuild(VkResult result, const char* call)
{
    if (result == VK_ERROR_SURFACE_LOST_KHR) {
        clear();
        vkDestroySurfaceKHR(context_.instance(), surface_, nullptr);
        surface_ = VK_NULL_HANDLE;
        makeSurface();
        return true;
    }
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        return true;
    }
    if (result != VK_SUBOPTIMAL_KHR) {
        checkVulkan(result, call);
    }
    return false;
}

bool Swapchain::show(const std::function<void(VkCommandBuffer, size_t image)>& record)
{
    uint32_t index = 0;
    const VkResult acquired =
        vkAcquireNextImageKHR(context_.device(), swapchain_, UINT64_MAX, acquired_.get(), VK_NULL_HANDLE, &index);
    if (mustRebuild(acquired, "vkAcquireNextImageKHR")) {
        return false;
    }
    const VkSemaphore drawn = drawn_[index].get();
    context_.run([&](VkCommandBuffer commands) { record(commands, index); }, acquired_.get(), drawn);
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &drawn,
                                .swapchainCount = 1,
                                .pSwapchains = &swapchain_,
                                .pImageIndices = &index};
    const VkResult presented = vkQueuePresentKHR(context_.queue(), &info);
    return presented != VK_SUBOPTIMAL_KHR && acquired != VK_SUBOPTIMAL_KHR &&
           !mustRebuild(presented, "vkQueuePresentKHR");
}

} // namespace nacre
