#include "engine/gpu/balls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "ball_display_frag.h"
#include "copy_frag.h"
#include "shared/ball.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array kOneInput = {ShaderBinding{kBindingInput, kTextureInput}};

static_assert(kConstantModulated == 0 && kConstantToneCurve == 1);

PassDescription displayPass(VkFormat format)
{
    return {.fragmentShader = ball_display_frag,
            .bindings = kOneInput,
            .pushConstantBytes = sizeof(BallDisplayConstants),
            .targetFormat = format,
            .cover = Cover::disc};
}

VkDeviceSize normalBytes(int size)
{
    return VkDeviceSize{4} * size * size;
}

VkExtent3D squareExtent(int size)
{
    return {static_cast<uint32_t>(size), static_cast<uint32_t>(size), 1};
}

VkDeviceSize radianceBytes(int size)
{
    return VkDeviceSize{sizeof(glm::vec4)} * size * size;
}

// As near to square as can be, so that many balls stay within the device's limits.
int columnsOf(size_t balls)
{
    return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(balls))));
}

} // namespace

BallCache::BallCache(const Context& context, DirectPass& direct, VkDeviceSize bytes)
    : context_(context), direct_(direct), limit_(bytes), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      linear_(makeSampler(context, VK_FILTER_LINEAR)),
      add_(context,
           {.fragmentShader = copy_frag, .bindings = kOneInput, .targetFormat = kFloatFormat, .blend = Blend::add}),
      encodeCodes_(context, displayPass(kCodeFormat)), encodeRadiance_(context, displayPass(kHalfFormat))
{
}

VkDeviceSize BallCache::leastBytes(std::span<const BallSize> sizes, bool modulated, size_t lights)
{
    const int columns = columnsOf(sizes.size());
    const auto rows = static_cast<int>((sizes.size() + columns - 1) / columns);
    VkDeviceSize bytes = 0;
    int largest = 0;
    for (const BallSize& size : sizes) {
        largest = std::max(largest, size.display);
        const VkDeviceSize chunk = lights > kLightsPerChunk ? radianceBytes(size.radiance) : 0;
        bytes += radianceBytes(size.radiance) + chunk + normalBytes(size.radiance);
    }
    return bytes + VkDeviceSize{modulated ? 8u : 4u} * columns * rows * largest * largest;
}

void BallCache::setMaterials(std::span<const BallSize> sizes, bool modulated)
{
    materials_.clear();
    normals_.clear();
    scratch_.clear();
    displaySize_ = 0;
    for (const BallSize& size : sizes) {
        materials_.push_back({size.radiance, {}, makeTarget(context_, squareExtent(size.radiance), kFloatFormat)});
        displaySize_ = std::max(displaySize_, size.display);
    }
    modulated_ = modulated;
    columns_ = columnsOf(sizes.size());
    const auto rows = static_cast<uint32_t>((sizes.size() + columns_ - 1) / columns_);
    const auto side = static_cast<uint32_t>(displaySize_);
    display_ = makeTarget(context_, {columns_ * side, rows * side, 1}, modulated ? kHalfFormat : kCodeFormat);
    keptBytes_ = leastBytes(sizes, modulated, 0);
    chunkIsStale_.assign(chunks_.size(), 1);
    sumIsStale_ = displayIsStale_ = true;
}

std::span<const Light> BallCache::lightsOf(const LightRange& chunk) const
{
    return std::span(lights_).subspan(chunk.first, chunk.last - chunk.first);
}

void BallCache::setLights(std::span<const Light> lights, std::span<const LightRange> ranges)
{
    std::vector<LightRange> chunks;
    for (const LightRange& range : ranges) {
        for (size_t first = range.first; first < range.last; first += kLightsPerChunk) {
            chunks.push_back({first, std::min(first + kLightsPerChunk, range.last)});
        }
    }
    if (chunks.empty()) {
        chunks.push_back({}); // without lights balls are black
    }
    std::vector<uint8_t> isStale(chunks.size(), 1);
    bool isOther = chunks.size() != chunks_.size();
    for (size_t i = 0; i < std::min(chunks.size(), chunks_.size()); ++i) {
        const auto before = lightsOf(chunks_[i]),
                   now = lights.subspan(chunks[i].first, chunks[i].last - chunks[i].first);
        const bool isSame = std::equal(before.begin(), before.end(), now.begin(), now.end());
        isStale[i] = !isSame || chunkIsStale_[i];
        isOther = isOther || !isSame;
    }
    sumIsStale_ = sumIsStale_ || isOther;
    if (!keepsChunks(chunks_.size()) || !keepsChunks(chunks.size())) {
        std::fill(isStale.begin(), isStale.end(), uint8_t{sumIsStale_});
    }
    lights_.assign(lights.begin(), lights.end());
    chunks_ = std::move(chunks);
    chunkIsStale_ = std::move(isStale);
}

void BallCache::setDisplay(const Display& display)
{
    displayIsStale_ = displayIsStale_ || !(display == displayOptions_);
    displayOptions_ = display;
}

// One chunk is the sum itself.
bool BallCache::keepsChunks(size_t count) const
{
    VkDeviceSize bytes = keptBytes_;
    for (const MaterialBalls& material : materials_) {
        bytes += count * radianceBytes(material.size);
    }
    return count > 1 && bytes <= limit_;
}

// Without a picture of its own, since it is one draw, which adds up to the same bytes: of what has just moved, and may
// well move again.
bool BallCache::isDrawnOnSum(size_t chunk) const
{
    const auto [first, last] = chunks_[chunk];
    return chunk > 0 && chunkIsStale_[chunk] != 0 && last - first <= kLightsPerGroup;
}

const Texture& BallCache::normalsOfBall(int size)
{
    auto found = normals_.find(size);
    if (found == normals_.end()) {
        std::vector<glm::vec4> texels(static_cast<size_t>(size) * size);
        for (size_t i = 0; i < texels.size(); ++i) {
            const glm::vec2 texel((i % size + 0.5f) / size, (i / size + 0.5f) / size);
            const glm::vec3 n = normalFromBallTexel(texel, static_cast<float>(size));
            // Just inside of the rim, which counts as visible, or filters would read black there.
            texels[i] = glm::vec4(
                std::min(1.0f, 0.9999f / glm::length(packedFromNormal(n)) / kPackedReach) * packedFromNormal(n), 0, 0);
        }
        found = normals_
                    .emplace(size,
                             uploadTexture(context_, VK_IMAGE_TYPE_2D, squareExtent(size), kPackedNormalFormat, texels))
                    .first;
    }
    return found->second;
}

bool BallCache::prepare()
{
    if (!sumIsStale_ && !displayIsStale_) {
        return false;
    }
    const bool keeps = keepsChunks(chunks_.size());
    for (MaterialBalls& material : materials_) {
        normalsOfBall(material.size);
        material.chunks.resize(keeps ? std::min(material.chunks.size(), chunks_.size()) : 0);
        while (keeps && material.chunks.size() < chunks_.size()) {
            material.chunks.push_back(makeTarget(context_, squareExtent(material.size), kFloatFormat));
        }
        if (!keeps && chunks_.size() > 1 && !scratch_.contains(material.size)) {
            scratch_.emplace(material.size, makeTarget(context_, squareExtent(material.size), kFloatFormat));
        }
    }
    return true;
}

void BallCache::record(VkCommandBuffer commands, std::span<const TableTexture> tables, const LightGroups& lights)
{
    for (size_t material = 0; sumIsStale_ && material < materials_.size(); ++material) {
        recordSum(commands, material, tables[material], lights);
    }
    if (sumIsStale_ || displayIsStale_) {
        recordDisplay(commands);
    }
    for (size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        chunkIsStale_[chunk] = chunks_.size() > 1 && isDrawnOnSum(chunk);
    }
    sumIsStale_ = displayIsStale_ = false;
}

void BallCache::recordLights(VkCommandBuffer commands, const Texture& target, Load load, size_t material,
                             const TableTexture& table, const LightGroups& lights, size_t chunk)
{
    const auto [first, last] = chunks_[chunk];
    beginRendering(commands, target, load);
    direct_.record(commands, {normalsOfBall(materials_[material].size), nullptr, table, 0}, lights, first, last);
    vkCmdEndRendering(commands);
    drawnLights_ += last - first;
}

void BallCache::recordChunk(VkCommandBuffer commands, const Texture& target, size_t material, const TableTexture& table,
                            const LightGroups& lights, size_t chunk)
{
    imageBarrier(commands, target.image(), kDiscarded, kDrawnTo);
    recordLights(commands, target, Load::clear, material, table, lights, chunk);
    imageBarrier(commands, target.image(), kDrawnTo, kSampled);
}

// The first is what the others are added to.
void BallCache::recordAdded(VkCommandBuffer commands, const Texture& sum, const Texture& picture, bool isFirst)
{
    if (isFirst) {
        imageBarrier(commands, picture.image(), kSampled, kCopiedFrom);
        imageBarrier(commands, sum.image(), kDiscarded, kCopiedTo);
        recordWholeCopy(commands, picture, sum);
        imageBarrier(commands, sum.image(), kCopiedTo, kDrawnTo);
        imageBarrier(commands, picture.image(), kCopiedFrom, kSampled);
        return;
    }
    imageBarrier(commands, sum.image(), kDrawnTo, kDrawnTo);
    beginRendering(commands, sum, Load::keep);
    const std::array inputs = {textureInput(kBindingInput, nearest_, picture)};
    draw(context_, commands, add_, inputs, {});
    vkCmdEndRendering(commands);
}

void BallCache::recordSum(VkCommandBuffer commands, size_t material, const TableTexture& table,
                          const LightGroups& lights)
{
    MaterialBalls& balls = materials_[material];
    if (chunks_.size() <= 1) {
        recordChunk(commands, balls.sum, material, table, lights, 0);
        return;
    }
    for (size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        if (isDrawnOnSum(chunk)) {
            imageBarrier(commands, balls.sum.image(), kDrawnTo, kDrawnTo);
            recordLights(commands, balls.sum, Load::keep, material, table, lights, chunk);
            continue;
        }
        const Texture& picture = balls.chunks.empty() ? scratch_.at(balls.size) : balls.chunks[chunk];
        if (balls.chunks.empty() || chunkIsStale_[chunk]) {
            recordChunk(commands, picture, material, table, lights, chunk);
        }
        recordAdded(commands, balls.sum, picture, chunk == 0);
    }
    imageBarrier(commands, balls.sum.image(), kDrawnTo, kSampled);
}

void BallCache::recordDisplay(VkCommandBuffer commands)
{
    const Pipeline& encode =
        (modulated_ ? encodeRadiance_ : encodeCodes_).with({modulated_, displayOptions_.toneCurve});
    imageBarrier(commands, display_.image(), kDiscarded, kDrawnTo);
    for (size_t material = 0; material < materials_.size(); ++material) {
        const int column = static_cast<int>(material) % columns_, row = static_cast<int>(material) / columns_;
        const VkRect2D area{.offset = {column * displaySize_, row * displaySize_},
                            .extent = {static_cast<uint32_t>(displaySize_), static_cast<uint32_t>(displaySize_)}};
        const BallDisplayConstants constants{.origin = {area.offset.x, area.offset.y},
                                             .size = static_cast<float>(displaySize_),
                                             .inputSize = static_cast<float>(materials_[material].size),
                                             .gain = std::exp2(displayOptions_.exposureStops)};
        const std::array inputs = {textureInput(kBindingInput, linear_, materials_[material].sum)};
        beginRendering(commands, display_, Load::clear, area);
        draw(context_, commands, encode, inputs, bytesOf(constants));
        vkCmdEndRendering(commands);
    }
    imageBarrier(commands, display_.image(), kDrawnTo, kSampled);
}

VkDeviceSize BallCache::bytes() const
{
    VkDeviceSize bytes = display_.bytes();
    for (const MaterialBalls& material : materials_) {
        bytes += material.sum.bytes();
        for (const Texture& chunk : material.chunks) {
            bytes += chunk.bytes();
        }
    }
    for (const auto* textures : {&normals_, &scratch_}) {
        for (const auto& [size, texture] : *textures) {
            bytes += texture.bytes();
        }
    }
    return bytes;
}

} // namespace nacre
