#include "engine/exchange/gltf_picture.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/whole_file.h"
#include "engine/scene/pixel_lights.h"
#include "shared/shading.h"

namespace nacre {
namespace {

struct GltfTexel {
    LobeShape shape;
    LobeColours colours;
    glm::vec3 normal{0, 0, 1};
};

class GltfTextures {
public:
    explicit GltfTextures(const GltfScene& scene) : m_(scene.material)
    {
        const TemporaryFolder folder;
        for (const std::string& png : scene.images) {
            writeTextFile(folder.path() / "texture.png", png);
            pictures_.push_back(loadImage(folder.path() / "texture.png"));
        }
    }

    bool isThere(int x, int y) const { return number(m_.baseColorTexture, x, y, 3) > 0.5f; }
    GltfTexel at(int x, int y) const
    {
        GltfTexel lobes;
        const glm::vec3 base = m_.baseColor * colour(m_.baseColorTexture, x, y);
        LobeShape& s = lobes.shape;
        s.roughness = m_.roughness * number(m_.metallicRoughnessTexture, x, y, 1);
        s.metallic = m_.metallic * number(m_.metallicRoughnessTexture, x, y, 2);
        s.specularWeight = m_.specular * number(m_.specularTexture, x, y, 3);
        s.sheenRoughness = m_.sheenRoughness * number(m_.sheenRoughnessTexture, x, y, 3);
        const float root = (m_.ior - 1) / (m_.ior + 1);
        const glm::vec3 dielectric = m_.specularColor * colour(m_.specularColorTexture, x, y);
        lobes.colours.diffuse = base;
        lobes.colours.specular =
            s.isMetal() ? base : s.specularWeight * glm::min(root * root * dielectric, glm::vec3(1));
        lobes.colours.sheen = m_.sheenColor * colour(m_.sheenColorTexture, x, y);
        if (m_.normalTexture) {
            lobes.normal = glm::normalize(2.0f * pictures_[*m_.normalTexture].rgb(x, y) - 1.0f);
        }
        return lobes;
    }

private:
    float number(const std::optional<int>& texture, int x, int y, int channel) const
    {
        return texture ? pictures_[*texture].at(x, y, channel) : 1;
    }
    glm::vec3 colour(const std::optional<int>& texture, int x, int y) const
    {
        if (!texture) {
            return glm::vec3(1);
        }
        const glm::vec3 code = pictures_[*texture].rgb(x, y);
        return {linearFromSrgb(code.x), linearFromSrgb(code.y), linearFromSrgb(code.z)};
    }

    const GltfMaterial& m_;
    std::vector<Image> pictures_;
};

// As many as there are materials: textures hold a shape for each label.
class GltfModels {
public:
    explicit GltfModels(bool hasSheen) : hasSheen_(hasSheen) {}
    const LobeModel& of(const LobeShape& shape)
    {
        const auto known = std::find_if(all_.begin(), all_.end(), [&](const auto& one) { return one.first == shape; });
        return known != all_.end() ? *known->second : *all_.emplace_back(shape, gltfModel(shape, hasSheen_)).second;
    }

private:
    bool hasSheen_;
    std::vector<std::pair<LobeShape, std::unique_ptr<LobeModel>>> all_;
};

} // namespace

Image gltfPicture(const GltfScene& scene, const Surface& surface, std::span<const Light> lights)
{
    const GltfTextures textures(scene);
    GltfModels models(scene.material.sheenColor != glm::vec3(0));
    const PixelLights reaching(surface, lights, kFrontView);
    Image radiance(surface.normals.width, surface.normals.height, 3);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            if (!textures.isThere(x, y)) {
                continue;
            }
            const size_t pixel = surface.normals.index(x, y);
            const GltfTexel lobes = textures.at(x, y);
            const LobeModel& model = models.of(lobes.shape);
            glm::vec3 sum(0);
            for (size_t i = 0; i < reaching.size(); ++i) {
                const PixelLights::Met met = reaching.at(i, pixel);
                const glm::vec3& l = met.light.direction;
                const glm::vec3 f = model.evaluate(lobes.colours, lobes.normal, l, reaching.view(pixel));
                sum += met.share * std::max(glm::dot(lobes.normal, l), 0.0f) * met.light.irradiance * f;
            }
            radiance.setRgb(x, y, scene.radianceScale * sum);
        }
    }
    return radiance;
}

} // namespace nacre
