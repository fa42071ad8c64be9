#include "engine/viewer/ui_pass.h"

#include <algorithm>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include "engine/gpu/check.h"

namespace nacre {

namespace {

constexpr float kFontPixels = 15;
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"; // apt.txt: fonts-dejavu-core

// Keeps what the image holds, and hands it over for presenting.
VkRenderPass makeRenderPass(VkDevice device, VkFormat format)
{
    const VkAttachmentDescription attachment{.format = format,
                                             .samples = VK_SAMPLE_COUNT_1_BIT,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                             .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &reference};
    const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                      .attachmentCount = 1,
                                      .pAttachments = &attachment,
                                      .subpassCount = 1,
                                      .pSubpasses = &subpass};
    return created(vkCreateRenderPass, "vkCreateRenderPass", device, info);
}

// For the font.
VkDescriptorPool makeDescriptorPool(VkDevice device)
{
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                          .maxSets = 1,
                                          .poolSizeCount = 1,
                                          .pPoolSizes = &size};
    return created(vkCreateDescriptorPool, "vkCreateDescriptorPool", device, info);
}

void chooseFont(float scale)
{
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    // Latin and the degree sign, minus, middle dot and arrows that the panels write.
    static constexpr ImWchar kRanges[] = {0x20, 0xFF, 0x2010, 0x2027, 0x2190, 0x2193, 0x2212, 0x2212, 0};
    if (FILE* file = std::fopen(kFont, "rb")) {
        std::fclose(file);
        fonts.AddFontFromFileTTF(kFont, kFontPixels * scale, nullptr, kRanges);
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * scale; // the built-in font is made for 13 pixels
        fonts.AddFontDefault(&config);
    }
}

void chooseStyle(float scale)
{
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.11f, 0.11f, 0.12f, 1);
    style.ScaleAllSizes(scale);
}

} // namespace

UiPass::UiPass(const Context& context, const Window& window, const Swapchain& swapchain, float scale)
    : context_(context), scale_(scale),
      renderPass_(context.device(), makeRenderPass(context.device(), swapchain.format())),
      descriptors_(context.device(), makeDescriptorPool(context.device()))
{
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // leaves no files behind
    chooseFont(scale_);
    chooseStyle(scale_);
    ImGui_ImplGlfw_InitForVulkan(window.get(), true); // its callbacks call those that are there
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = context.instance();
    info.PhysicalDevice = context.physicalDevice();
    info.Device = context.device();
    info.QueueFamily = context.queueFamily();
    info.Queue = context.queue();
    info.DescriptorPool = descriptors_.get();
    info.MinImageCount = 2;
    info.ImageCount = static_cast<uint32_t>(std::max<size_t>(swapchain.imageCount(), 2));
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = [](VkResult result) { checkVulkan(result, "a call of ImGui's"); };
    ImGui_ImplVulkan_Init(&info, renderPass_.get());
    context.run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

UiPass::~UiPass()
{
    vkDeviceWaitIdle(context_.device());
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void UiPass::begin()
{
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void UiPass::end()
{
    ImGui::Render();
}

void UiPass::makeFramebuffers(const Swapchain& swapchain)
{
    framebuffers_.clear();
    for (size_t i = 0; i < swapchain.imageCount(); ++i) {
        const VkImageView view = swapchain.view(i);
        const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                           .renderPass = renderPass_.get(),
                                           .attachmentCount = 1,
                                           .pAttachments = &view,
                                           .width = swapchain.extent().width,
                                           .height = swapchain.extent().height,
                                           .layers = 1};
        framebuffers_.emplace_back(context_.device(),
                                   created(vkCreateFramebuffer, "vkCreateFramebuffer", context_.device(), info));
    }
    generation_ = swapchain.generation();
}

void UiPass::record(VkCommandBuffer commands, const Swapchain& swapchain, size_t image)
{
    if (generation_ != swapchain.generation()) {
        makeFramebuffers(swapchain);
    }
    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = renderPass_.get(),
                                      .framebuffer = framebuffers_[image].get(),
                                      .renderArea = {.extent = swapchain.extent()}};
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    vkCmdEndRenderPass(commands);
}

} // namespace nacre
