#include "engine/gpu/direct_frame.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "copy_frag.h"
#include "direct_frag.h"
#include "display_frag.h"
#include "engine/surface/object_places.h"
#include "shared/layout.h"

namespace nacre {
namespace {

// 256 bytes is the coarsest offset into a uniform buffer that a device may ask for.
static_assert(kLightsPerGroup * sizeof(LightFrame) % 256 == 0);
constexpr VkDeviceSize kGroupBytes = kLightsPerGroup * sizeof(LightFrame);

constexpr std::array<uint8_t, 1> kNoCodes = {0};
constexpr std::array kDirectBindings = {
    ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingTable, kTextureInput},   ShaderBinding{kBindingLights, kUniformInput},
    ShaderBinding{kBindingHorizon, kTextureInput}, ShaderBinding{kBindingPlaces, kTextureInput}};
static_assert(kConstantLightCount == 0 && kConstantCoordinates == 1 && kConstantOneMaterial == 2 &&
              kConstantPacked == 3 && kConstantCoverage == 4 && kConstantShadows == 5 && kConstantPlaced == 6);

// Of the lights of a group.
void fillHorizon(DirectConstants& constants, std::span<const Light> lights, uint32_t azimuths)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        constants.horizon[i] = horizonLookup(lights[i].direction, static_cast<int>(azimuths));
    }
}

void fillNearness(DirectConstants& constants, std::span<const Light> lights)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        constants.nearness[i] = isNear(lights[i]) ? 1 / lights[i].distance : 0.0f;
    }
}

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
    rows.places = cut(surface.places, from, pixels);
    rows.albedo.values = cut(surface.albedo.values, 3 * from, 3 * pixels);
    std::vector<int64_t> picked(pixels);
    std::iota(picked.begin(), picked.end(), static_cast<int64_t>(from));
    rows.horizon = pickedHorizon(surface.horizon, picked, width, count);
    rows.residual = pickedResidual(surface.residual, picked, width, count);
    return rows;
}

// What of `part` lies in the rows, which begin at row 0 of their own.
VkRect2D inRows(const VkRect2D& part, const VkRect2D& rows)
{
    const int end = part.offset.y + static_cast<int>(part.extent.height) - rows.offset.y;
    const int low = std::max(part.offset.y - rows.offset.y, 0),
              high = std::min(end, static_cast<int>(rows.extent.height));
    return {.offset = {part.offset.x, low},
            .extent = {part.extent.width, static_cast<uint32_t>(std::max(high - low, 0))}};
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

void LightGroups::upload(const Context& context, std::span<const Light> lights, const glm::vec4& viewpoint)
{
    const size_t groups = std::max<size_t>(1, (lights.size() + kLightsPerGroup - 1) / kLightsPerGroup);
    if (buffer_.bytes() < groups * kGroupBytes) {
        buffer_ = Buffer(context, groups * kGroupBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }
    lights_.assign(lights.begin(), lights.end());
    viewpoint_ = viewpoint;
    std::transform(lights.begin(), lights.end(), static_cast<LightFrame*>(buffer_.mapped()), [&](const Light& light) {
        return lightFrame(light.direction, glm::vec3(viewpoint), light.irradiance);
    });
}

ShaderInput LightGroups::group(size_t index) const
{
    return uniformInput(kBindingLights, buffer_, index * kGroupBytes, kGroupBytes);
}

DirectPass::DirectPass(const Context& context)
    : context_(context), pipelines_(context, {.fragmentShader = direct_frag,
                                              .bindings = kDirectBindings,
                                              .pushConstantBytes = sizeof(DirectConstants),
                                              .targetFormat = kFloatFormat,
                                              .blend = Blend::add}),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)), linear_(makeSampler(context, VK_FILTER_LINEAR)),
      noHorizon_(uploadLayers(context, {1, 1, 1}, 1, kNoCodes))
{
}

void DirectPass::record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first,
                        size_t last)
{
    assert(first % kLightsPerGroup == 0);
    const VkExtent3D size = inputs.table.texture.extent();
    const TableDomain& domain = inputs.table.domain;
    DirectConstants constants{.view = lights.viewpoint(),
                              .tableSize = glm::vec4(size.width, size.height, size.depth, domain.thetaDMax),
                              .material = inputs.material,
                              .firstRow = inputs.firstRow,
                              .nearness = {},
                              .horizon = {}};
    const Texture& albedo = inputs.albedo ? *inputs.albedo : inputs.normals; // bound, but not read
    const Texture& horizon = inputs.horizon ? *inputs.horizon : noHorizon_;
    const Texture& places = inputs.places ? *inputs.places : inputs.normals;
    for (size_t light = first; light < last; light += kLightsPerGroup) {
        const auto count = static_cast<int>(std::min<size_t>(last - light, kLightsPerGroup));
        const std::array shaderInputs = {
            textureInput(kBindingNormals, nearest_, inputs.normals),    textureInput(kBindingAlbedo, nearest_, albedo),
            textureInput(kBindingTable, linear_, inputs.table.texture), lights.group(light / kLightsPerGroup),
            textureInput(kBindingHorizon, nearest_, horizon),           textureInput(kBindingPlaces, nearest_, places)};
        const std::span<const Light> group = lights.lights().subspan(light, static_cast<size_t>(count));
        const bool placed = inputs.places && (anyIsNear(group) || lights.viewpoint().w > 0);
        if (placed) {
            fillNearness(constants, group);
        }
        if (inputs.horizon) {
            fillHorizon(constants, group, horizon.layers());
        }
        const Pipeline& pipeline = pipelines_.with(
            {count, domain.coordinates, inputs.albedo == nullptr, inputs.normals.format() == kPackedNormalFormat,
             inputs.coverage && inputs.table.knowsCoverage, inputs.horizon != nullptr, placed});
        draw(context_, commands, pipeline, shaderInputs, bytesOf(constants));
    }
}

DirectFrame::DirectFrame(const Context& context, DirectPass& direct)
    : context_(context), direct_(direct), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      encoders_(context, {.fragmentShader = display_frag,
                          .bindings = kDisplayBindings,
                          .pushConstantBytes = sizeof(DisplayConstants),
                          .targetFormat = kCodeFormat}),
      add_(context, {.fragmentShader = copy_frag,
                     .bindings = kDisplayBindings,
                     .targetFormat = kFloatFormat,
                     .blend = Blend::add})
{
}

void DirectFrame::reset()
{
    still_ = {};
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

// One draw per material and group of lights; what they write adds up. Row 0 of the target is the surface's `firstRow`.
void DirectFrame::recordLights(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                               const LightRange& lights, int firstRow, bool coverage)
{
    for (size_t material = 0; material < inputs.tables.size(); ++material) {
        direct_.record(commands,
                       {.normals = pixels.normals,
                        .albedo = inputs.plain ? nullptr : &pixels.albedo,
                        .table = inputs.tables[material],
                        .material = static_cast<int>(material),
                        .firstRow = firstRow,
                        .coverage = coverage,
                        .horizon = pixels.horizon.bytes() > 0 ? &pixels.horizon : nullptr,
                        .places = pixels.places.bytes() > 0 ? &pixels.places : nullptr},
                       inputs.lights, lights.first, lights.last);
    }
}

void DirectFrame::recordStill(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                              bool coverage)
{
    const std::span<const Light> lights = inputs.lights.lights().subspan(0, inputs.still.last);
    Kept wanted{{lights.begin(), lights.end()}, inputs.lights.viewpoint(), coverage};
    if (still_.bytes() > 0 && wanted == kept_) {
        return;
    }
    if (still_.bytes() == 0) {
        still_ = makeTarget(context_, band_.extent(), kFloatFormat);
    }
    kept_ = std::move(wanted);
    imageBarrier(commands, still_.image(), kDiscarded, kDrawnTo);
    beginRendering(commands, still_, Load::clear);
    vkCmdSetScissor(commands, 0, 1, &pixels.shown);
    recordLights(commands, pixels, inputs, inputs.still, 0, coverage);
    vkCmdEndRendering(commands);
    imageBarrier(commands, still_.image(), kDrawnTo, kSampled);
}

// `rows` are the target's, its offset the surface's.
void DirectFrame::recordRows(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, VkRect2D rows,
                             bool coverage, bool fromStill)
{
    imageBarrier(commands, band_.image(), kDiscarded, kDrawnTo);
    beginRendering(commands, band_, Load::clear, {.offset = {}, .extent = rows.extent});
    const VkRect2D shown = inRows(pixels.shown, rows);
    vkCmdSetScissor(commands, 0, 1, &shown);
    if (fromStill) {
        const std::array kept = {textureInput(kBindingInput, nearest_, still_)};
        draw(context_, commands, add_, kept, {});
    } else {
        recordLights(commands, pixels, inputs, inputs.still, rows.offset.y, coverage);
    }
    recordLights(commands, pixels, inputs, inputs.moved, rows.offset.y, coverage);
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
    const bool keeps = inputs.still.last > 0 && atOnce >= height;
    if (keeps) {
        recordStill(commands, pixels, inputs, look.hatched);
    } else {
        still_ = {};
    }
    for (int first = 0; first < height; first += atOnce) {
        const VkRect2D rows{.offset = {0, first},
                            .extent = {size.width, static_cast<uint32_t>(std::min(atOnce, height - first))}};
        recordRows(commands, pixels, inputs, rows, look.hatched, keeps);
        imageBarrier(commands, band_.image(), kDrawnTo, kSampled);
        VkRect2D shown = inRows(pixels.shown, rows);
        shown.offset.y += first;
        beginRendering(commands, codes, Load::keep, rows);
        vkCmdSetScissor(commands, 0, 1, &shown);
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
        recordRows(commands, isWhole ? whole_ : part, inputs, rows, false, false);
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
    return band_.bytes() + still_.bytes() + readback_.bytes() + whole_.bytes();
}

} // namespace nacre
