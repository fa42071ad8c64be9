#pragma once
#include <map>
#include <memory>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pass.h"
#include "engine/target/mesh.h"

namespace nacre {

// Draws a mesh to one target again and again: what the device holds for it stays.
class MeshPasses {
public:
    // What is drawn of a sample: of kFloatFormat x and y of the normal, the height in pixels, the label + 1, all 0
    // where nothing is seen; or of kPackedFormat the normal alone, as shaders/shared/ball.h packs it.
    enum class Draws { samples, packedNormals };
    static constexpr VkFormat kPackedFormat = VK_FORMAT_R32G32_SFLOAT; // which every device draws to

    // `target` has samplesPerSide samples along each side of a pixel; it is in `after` once it is drawn. What is
    // referred to has to stay.
    MeshPasses(const Context& context, const Mesh& mesh, Draws draws, const Texture& target, int samplesPerSide,
               const ImageUse& after);

    void draw(const MeshView& view);

    const Texture& target() const { return target_; }
    int samplesPerSide() const { return samplesPerSide_; }

private:
    const Texture* normalMapOf(const MeshPart& part);
    void fillVertices(size_t firstIndex, size_t count);
    void beginDrawing(VkCommandBuffer commands);
    void record(VkCommandBuffer commands, uint32_t vertexCount, float label, const Texture* map);

    const Context& context_;
    const Mesh& mesh_;
    Draws draws_;
    const Texture& target_;
    int samplesPerSide_;
    ImageUse after_;
    Texture depth_;
    Buffer vertices_;
    Sampler nearest_;
    Texture noMap_; // the shader has a place for one
    Pipelines pipelines_;
    MeshView view_;
    std::map<const NormalMap*, Texture> maps_; // made for the size at which they are seen
    double mapsPixelsPerUnit_ = 0;
    bool isEmpty_ = true;
};

} // namespace nacre
