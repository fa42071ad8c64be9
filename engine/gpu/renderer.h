#pragma once
#include <span>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/texture.h"
#include "engine/scene/scene.h"

namespace nacre {

// Draws a surface under distant lights into linear radiance, without a window. The context must live longer.
class Renderer {
public:
    explicit Renderer(const Context& context);

    // Uploads normals, albedo factors, labels and tables; they stay until the next call.
    void setSurface(const Surface& surface);

    // The surface that was set, under any number of lights. view is unit, towards the viewer.
    Frame render(std::span<const Light> lights, const glm::vec3& view = {0, 0, 1});

    // setSurface, then render.
    Frame render(const Scene& scene);

private:
    struct Table {
        Texture texture;
        TableDomain domain;
    };

    void uploadLights(std::span<const Light> lights);
    void recordPasses(VkCommandBuffer commands, size_t lightCount, const glm::vec3& view) const;
    Frame readBack() const;

    const Context& context_;
    Pipeline pipeline_;
    Sampler nearest_;
    Sampler linear_;
    Texture normals_; // xyz, w = confidence
    Texture albedo_;  // rgb, w = material index
    std::vector<Table> tables_;
    Buffer lights_;
    Texture target_; // linear radiance
    Buffer readback_;
};

} // namespace nacre
