#include "engine/gpu/direct_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "display_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array kDisplayBindings = {ShaderBinding{kBindingInput, kTextureInput}};
static_assert(kConstantHatched == 0 && kConstantToneCurve == 1);

template <class T> std::vector<T> cut(const std::vector<T>& values, size_t first, size_t count)
{
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(first);
    return values.empty() ? values : std::vector<T>(from, from + static_cast<std::ptrdiff_t>(count));
}

// The surface's pixels in some rows.
Surface rowsOf(const Surface& surface, int first, int count)
{
    const int width = surface.normals.width;
    const size_t from = static_cast<size_t>(width) * first, pixels = static_cast<size_t>(width) * count;
    Surface rows;
    rows.normals.width = width;
    rows.normals.height = count;
    rows.normals.normals = cut(surface.normals.normals, from, pixels);
    rows.normals.confidence = cut(surface.normals.confidence, from, pixels);
    rows.labels = cut(surface.labels, from, pixels);
    rows.albedo.values = cut(surface.albedo.values, 3 * from, 3 * pixels);
    std::vector<int64_t> picked(pixels);
    std::iota(picked.begin(), picked.end(), static_cast<int64_t>(from));
    rows.horizon = pickedHorizon(surface.horizon, picked, width, count);
    rows.residual = pickedResidual(surface.residual, picked, width, count);
    return rows;
}

void copyRows(const Buffer& texels, Frame& frame, int first, int count)
{
    const auto* from = static_cast<const glm::vec4*>(texels.mapped());
    float* to = &frame.values[frame.index(0, first)];
    for (int i = 0; i < frame.width * count; ++i) {
        for (int c = 0; c < 3; ++c) {
            to[3 * i + c] = std::max(from[i][c], 0.0f); // residuals may take more than there is
        }
    }
}

} // namespace

DirectFrame::DirectFrame(const Context& context, DirectPass& direct)
    : context_(context), direct_(direct), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      encoders_(context, {.fragmentShader = display_frag,
                          .bindings = kDisplayBindings,
                          .pushConstantBytes = sizeof(DisplayConstants),
                          .targetFormat = kCodeFormat})
{
}

void DirectFrame::reset()
{
    band_ = {};
    readback_ = {};
    whole_ = {};
}

// As few bands as can be, of even heights.
int DirectFrame::rowsAtOnce(VkExtent3D picture)
{
    if (band_.bytes() == 0) {
        const uint32_t most = std::max(1u, kBandTexels / picture.width);
        const uint32_t bands = (picture.height + most - 1) / most;
        band_ = makeTarget(context_, {picture.width, (picture.height + bands - 1) / bands, 1}, kFloatFormat);
    }
    return static_cast<int>(band_.extent().height);
}

// One draw per material and group of lights; what they write adds up. `rows` are the target's, its offset the
// surface's.
void DirectFrame::recordRows(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, VkRect2D rows,
                             bool coverage)
{
    imageBarrier(commands, band_.image(), kDiscarded, kDrawnTo);
    beginRendering(commands, band_, Load::clear, {.offset = {}, .extent = rows.extent});
    for (size_t material = 0; material < inputs.tables.size(); ++material) {
        direct_.record(commands,
                       {.normals = pixels.normals,
                        .albedo = inputs.plain ? nullptr : &pixels.albedo,
                        .table = inputs.tables[material],
                        .material = static_cast<int>(material),
                        .firstRow = rows.offset.y,
                        .coverage = coverage,
                        .horizon = pixels.horizon.bytes() > 0 ? &pixels.horizon : nullptr},
                       inputs.lights, 0, inputs.lights.lightCount());
    }
    if (inputs.residual) {
        inputs.residual->record(commands, pixels, static_cast<int>(inputs.tables.size()), rows.offset.y);
    }
    vkCmdEndRendering(commands);
}

void DirectFrame::recordPicture(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                                const Look& look, const Texture& codes)
{
    const Pipeline& encode = encoders_.with({look.hatched, look.display.toneCurve});
    const VkExtent3D size = codes.extent();
    const int height = static_cast<int>(size.height), atOnce = rowsAtOnce(size);
    for (int first = 0; first < height; first += atOnce) {
        const VkRect2D rows{.offset = {0, first},
                            .extent = {size.width, static_cast<uint32_t>(std::min(atOnce, height - first))}};
        recordRows(commands, pixels, inputs, rows, look.hatched);
        imageBarrier(commands, band_.image(), kDrawnTo, kSampled);
        beginRendering(commands, codes, Load::clear, rows);
        const std::array shaderInputs = {textureInput(kBindingInput, nearest_, band_)};
        draw(context_, commands, encode, shaderInputs,
             bytesOf(DisplayConstants{.gain = std::exp2(look.display.exposureStops), .firstRow = first}));
        vkCmdEndRendering(commands);
    }
}

// Draws one band from its own 32-bit inputs and reads it back.
void DirectFrame::readRows(const Surface& pixels, const Inputs& inputs, Frame& frame, int first, int count)
{
    const bool isWhole = count == frame.height;
    PixelTextures part;
    if (!isWhole || whole_.bytes() == 0) {
        part = uploadPixels(context_, isWhole ? pixels : rowsOf(pixels, first, count), inputs.plain, Precision::full);
    }
    if (isWhole && whole_.bytes() == 0) {
        whole_ = std::move(part);
    }
    const VkRect2D rows{.offset = {}, .extent = {band_.extent().width, static_cast<uint32_t>(count)}};
    context_.run([&](VkCommandBuffer commands) {
        recordRows(commands, isWhole ? whole_ : part, inputs, rows, false);
        imageBarrier(commands, band_.image(), kDrawnTo, kCopiedFrom);
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = {rows.extent.width, rows.extent.height, 1}};
        vkCmdCopyImageToBuffer(commands, band_.image(), kCopiedFrom.layout, readback_.get(), 1, &copy);
        makeVisibleToHost(commands, readback_);
    });
    copyRows(readback_, frame, first, count);
}

Frame DirectFrame::radiance(const Surface& pixels, const Inputs& inputs)
{
    Frame frame(pixels.normals.width, pixels.normals.height, 3);
    const int atOnce = rowsAtOnce({static_cast<uint32_t>(frame.width), static_cast<uint32_t>(frame.height), 1});
    if (readback_.bytes() == 0) {
        readback_ = Buffer(context_, VkDeviceSize{band_.extent().width} * band_.extent().height * sizeof(glm::vec4),
                           VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    }
    for (int first = 0; first < frame.height; first += atOnce) {
        readRows(pixels, inputs, frame, first, std::min(atOnce, frame.height - first));
    }
    return frame;
}

VkDeviceSize DirectFrame::bytes() const
{
    return band_.bytes() + readback_.bytes() + whole_.bytes();
}

} // namespace nacre
