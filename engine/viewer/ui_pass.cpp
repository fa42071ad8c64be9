#include "engine/viewer/ui_pass.h"

#include <algorithm>
#include <array>
#include <bit>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <glm/common.hpp>
#include <imgui.h>

#include "engine/files/hash_random.h"
#include "engine/gpu/check.h"

namespace nacre {

namespace {

constexpr float kFontPixels = 15;
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"; // apt.txt: fonts-dejavu-core

// Keeps what the image holds.
VkRenderPass makeRenderPass(VkDevice device, VkFormat format)
{
    const VkAttachmentDescription attachment{.format = format,
                                             .samples = VK_SAMPLE_COUNT_1_BIT,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                             .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
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

struct Triangle {
    ImDrawVert corners[3];
};

glm::vec2 pixelOf(const ImVec2& at, const ImDrawData& frame)
{
    return {(at.x - frame.DisplayPos.x) * frame.FramebufferScale.x,
            (at.y - frame.DisplayPos.y) * frame.FramebufferScale.y};
}

PixelBox clipOf(const ImDrawCmd& command, const ImDrawData& frame)
{
    const ImVec4& clip = command.ClipRect;
    return {glm::ivec2(glm::floor(pixelOf({clip.x, clip.y}, frame))),
            glm::ivec2(glm::ceil(pixelOf({clip.z, clip.w}, frame)))};
}

PixelBox boxOf(const Triangle& triangle, const ImDrawData& frame)
{
    const glm::vec2 a = pixelOf(triangle.corners[0].pos, frame), b = pixelOf(triangle.corners[1].pos, frame),
                    c = pixelOf(triangle.corners[2].pos, frame);
    return {glm::ivec2(glm::floor(glm::min(glm::min(a, b), c))), glm::ivec2(glm::ceil(glm::max(glm::max(a, b), c)))};
}

template <class T> uint64_t lookOf(const T& drawn)
{
    static_assert(sizeof(T) % sizeof(uint32_t) == 0 && std::is_trivially_copyable_v<T>);
    uint64_t look = 0;
    for (const uint32_t word : std::bit_cast<std::array<uint32_t, sizeof(T) / sizeof(uint32_t)>>(drawn)) {
        look = (look ^ word) * kHashStep;
        look ^= look >> 32;
    }
    return look;
}

Triangle triangleOf(const ImDrawList& list, const ImDrawCmd& command, unsigned int first)
{
    const auto corner = [&](unsigned int k) {
        const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + first + k)];
        return list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
    };
    return {corner(0), corner(1), corner(2)};
}

// The command within the box; its indices, of what reaches into the box, at the end of `indices`.
ImDrawCmd clippedTo(const PixelBox& box, const ImDrawCmd& command, const ImDrawList& list, const ImDrawData& frame,
                    ImVector<ImDrawIdx>& indices)
{
    const PixelBox part = overlap(clipOf(command, frame), box);
    const ImVec2 &from = frame.DisplayPos, &scale = frame.FramebufferScale;
    ImDrawCmd within = command;
    within.ClipRect = {
        from.x + static_cast<float>(part.low.x) / scale.x, from.y + static_cast<float>(part.low.y) / scale.y,
        from.x + static_cast<float>(part.high.x) / scale.x, from.y + static_cast<float>(part.high.y) / scale.y};
    within.IdxOffset = static_cast<unsigned int>(indices.Size);
    for (unsigned int i = 0; i < command.ElemCount && !part.isEmpty(); i += 3) {
        if (!overlap(boxOf(triangleOf(list, command, i), frame), part).isEmpty()) {
            for (unsigned int k = 0; k < 3; ++k) {
                indices.push_back(list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)]);
            }
        }
    }
    within.ElemCount = static_cast<unsigned int>(indices.Size) - within.IdxOffset;
    return within;
}

// What the list draws, box by box and no farther than these.
void clipTo(std::span<const PixelBox> boxes, const ImDrawData& frame, ImDrawList& list)
{
    ImVector<ImDrawCmd> commands;
    ImVector<ImDrawIdx> indices;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        for (const PixelBox& box : boxes) {
            const ImDrawCmd within = clippedTo(box, command, list, frame, indices);
            if (within.ElemCount > 0) {
                commands.push_back(within);
            }
        }
    }
    list.CmdBuffer.swap(commands);
    list.IdxBuffer.swap(indices);
}

} // namespace

UiPass::UiPass(const Context& context, const Window& window, const Swapchain& swapchain, float scale)
    : context_(context), scale_(scale),
      renderPass_(context.device(), makeRenderPass(context.device(), swapchain.format())),
      descriptors_(context.device(), makeDescriptorPool(context.device()))
{
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;       // leaves no files behind
    ImGui::GetIO().MouseDoubleClickTime = 0.5f; // seconds; frames may take a tenth of one, and a click two of them
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

void UiPass::addLooks(ChangedTiles& tiles) const
{
    const ImDrawData& frame = *ImGui::GetDrawData();
    for (int l = 0; l < frame.CmdListsCount; ++l) {
        const ImDrawList& list = *frame.CmdLists[l];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const PixelBox clip = clipOf(command, frame);
            const uint64_t look = lookOf(clip);
            for (unsigned int i = 0; i < command.ElemCount; i += 3) {
                const Triangle triangle = triangleOf(list, command, i);
                tiles.add(overlap(boxOf(triangle, frame), clip), hashOf(look ^ lookOf(triangle)));
            }
        }
    }
}

void UiPass::makeFramebuffer(const Texture& target)
{
    const VkImageView view = target.view();
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = renderPass_.get(),
                                       .attachmentCount = 1,
                                       .pAttachments = &view,
                                       .width = target.extent().width,
                                       .height = target.extent().height,
                                       .layers = 1};
    framebuffer_ = {context_.device(), created(vkCreateFramebuffer, "vkCreateFramebuffer", context_.device(), info)};
}

void UiPass::record(VkCommandBuffer commands, const Texture& target, std::span<const PixelBox> boxes)
{
    makeFramebuffer(target);
    ImDrawData& frame = *ImGui::GetDrawData();
    frame.TotalIdxCount = 0;
    for (int l = 0; l < frame.CmdListsCount; ++l) {
        clipTo(boxes, frame, *frame.CmdLists[l]);
        frame.TotalIdxCount += frame.CmdLists[l]->IdxBuffer.Size;
    }
    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = renderPass_.get(),
                                      .framebuffer = framebuffer_.get(),
                                      .renderArea = {.extent = {target.extent().width, target.extent().height}}};
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(&frame, commands);
    vkCmdEndRenderPass(commands);
}

} // namespace nacre
