#pragma once
#include <map>
#include <span>
#include <vector>

#include "engine/files/image.h"
#include "engine/gpu/direct_frame.h"
#include "engine/gpu/moving_lights.h"
#include "engine/gpu/pass.h"
#include "engine/scene/ball_size.h"

namespace nacre {

// The balls of a surface's materials. Radiance balls are drawn in chunks of at most kLightsPerChunk lights, summed in
// the chunks' order: as long as the chunks' own balls fit into the cache, a light that moves costs its chunk alone, and
// the sum is the same bytes as a fresh one. Display balls are made from the sums.
class BallCache {
public:
    static constexpr size_t kLightsPerChunk = 16;

    BallCache(const Context& context, DirectPass& direct, VkDeviceSize bytes);

    // What balls of these sizes take under so many lights before any chunk is kept.
    static VkDeviceSize leastBytes(std::span<const BallSize> sizes, bool modulated, size_t lights);

    // Drops all balls. `modulated`: pixels have labels or albedo factors.
    void setMaterials(std::span<const BallSize> sizes, bool modulated);
    // Chunks of which the last call knew no like in their place are to be drawn again. No chunk reaches across a
    // border between two ranges; those begin at multiples of kLightsPerGroup.
    void setLights(std::span<const Light> lights, std::span<const LightRange> ranges);
    void setDisplay(const Display& display);

    // Makes what record() needs; false where nothing has changed.
    bool prepare();
    // Draws what has changed. `lights` are those of setLights, for v = (0,0,1).
    void record(VkCommandBuffer commands, std::span<const TableTexture> tables, const LightGroups& lights);

    const Texture& displayBalls() const { return display_; } // side by side, as ball.frag wants them
    int displaySize() const { return displaySize_; }
    int columns() const { return columns_; }
    VkDeviceSize bytes() const;
    size_t drawnLights() const { return drawnLights_; } // since the start, per material

private:
    struct MaterialBalls {
        int size = 0;                // texels across, radiance
        std::vector<Texture> chunks; // empty where they are not kept
        Texture sum;
    };

    const Texture& normalsOfBall(int size);
    std::span<const Light> lightsOf(const LightRange& chunk) const;
    bool keepsChunks(size_t count) const;
    bool isDrawnOnSum(size_t chunk) const;
    void recordLights(VkCommandBuffer commands, const Texture& target, Load load, size_t material,
                      const TableTexture& table, const LightGroups& lights, size_t chunk);
    void recordChunk(VkCommandBuffer commands, const Texture& target, size_t material, const TableTexture& table,
                     const LightGroups& lights, size_t chunk);
    void recordAdded(VkCommandBuffer commands, const Texture& sum, const Texture& picture, bool isFirst);
    void recordSum(VkCommandBuffer commands, size_t material, const TableTexture& table, const LightGroups& lights);
    void recordDisplay(VkCommandBuffer commands);

    const Context& context_;
    DirectPass& direct_;
    VkDeviceSize limit_;
    Sampler nearest_;
    Sampler linear_;
    Pipeline add_;
    Pipelines encodeCodes_, encodeRadiance_; // where nothing, and where something is done to a pixel after the ball
    std::map<int, Texture> normals_;         // of the ball's texels, by size
    std::map<int, Texture> scratch_;         // where chunks are not kept, by size
    std::vector<MaterialBalls> materials_;
    std::vector<Light> lights_;
    std::vector<LightRange> chunks_;
    std::vector<uint8_t> chunkIsStale_; // one a chunk
    bool sumIsStale_ = true;
    bool displayIsStale_ = true;
    bool modulated_ = false;
    Display displayOptions_;
    VkDeviceSize keptBytes_ = 0; // leastBytes of the materials
    Texture display_;
    int displaySize_ = 0;
    int columns_ = 1;
    size_t drawnLights_ = 0;
};

} // namespace nacre
