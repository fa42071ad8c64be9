#pragma once
#include <map>
#include <tuple>

#include "engine/gpu/light_groups.h"
#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"

namespace nacre {

// Draws shaders/direct.frag: one material's radiance under a range of lights, added to the target, which has
// kFloatFormat and is being rendered to.
class DirectPass {
public:
    explicit DirectPass(const Context& context);

    struct Inputs {
        const Texture& normals;
        const Texture* albedo; // null: all pixels have the material, and albedo 1
        const TableTexture& table;
        int material;
        int firstRow = 0;      // of the surface, in the target's row 0
        bool coverage = false; // alpha counts what asks for unmeasured directions, where the table knows them
        const Texture* horizon = nullptr; // of the height that casts shadows; null: none does
    };
    // Lights [first, last) in order; first is a multiple of kLightsPerGroup.
    void record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first, size_t last);

private:
    struct Variant {
        int lightCount, coordinates, oneMaterial, packed, coverage, shadows;
        auto operator<=>(const Variant&) const = default;
    };
    const Pipeline& pipeline(const Variant& variant);

    const Context& context_;
    std::map<Variant, Pipeline> pipelines_; // made when first needed
    Sampler nearest_;
    Sampler linear_;
    Texture noHorizon_; // bound where there are no shadows, but not read
};

} // namespace nacre
