#include "tests/gpu/scene_mutants.h"

#include <algorithm>
#include <cmath>

#include "shared/shading.h"

namespace nacre::test {
namespace {

// Each texel from the same table at another place.
template <class Place> void resampleTables(Scene& scene, const Place& place)
{
    for (Material& material : scene.surface.materials) {
        const BrdfTable from = material.table;
        const glm::vec3 last(from.size - 1);
        for (int k = 0; k < from.size.z; ++k) {
            for (int j = 0; j < from.size.y; ++j) {
                for (int i = 0; i < from.size.x; ++i) {
                    const glm::vec3 unit = glm::vec3(i, j, k) / last;
                    material.table.values[from.index(i, j, k)] = sampleTable(from, place(unit, from)).value;
                }
            }
        }
    }
}

// 0 and 1 taken for the borders of the texture in place of the centres of its outer texels.
bool misplaceHalfTexel(Scene& scene)
{
    resampleTables(scene, [](const glm::vec3& unit, const BrdfTable& table) {
        return glm::clamp(unitFromTexel(unit, glm::vec3(table.size)), 0.0f, 1.0f);
    });
    return true;
}

// phiD measured from the wrong axis.
bool mirrorPhiD(Scene& scene)
{
    resampleTables(scene,
                   [](const glm::vec3& unit, const BrdfTable&) { return glm::vec3(unit.x, unit.y, 1 - unit.z); });
    return true;
}

bool flipLights(Scene& scene)
{
    for (Light& light : scene.lights) {
        light.direction.y = -light.direction.y;
    }
    return true;
}

// f / n.l, so that the renderer's cosine goes away; where the table has its grazing directions it is kept finite.
bool dropCosine(Scene& scene)
{
    constexpr float kLeastCosine = 0.05f;
    for (Material& material : scene.surface.materials) {
        BrdfTable& table = material.table;
        for (int k = 0; k < table.size.z; ++k) {
            for (int j = 0; j < table.size.y; ++j) {
                for (int i = 0; i < table.size.x; ++i) {
                    table.values[table.index(i, j, k)] /= std::max(table.directions(i, j, k).l.z, kLeastCosine);
                }
            }
        }
    }
    return true;
}

bool ignoreAlbedo(Scene& scene)
{
    const bool had = !scene.surface.albedo.values.empty();
    scene.surface.albedo = Image();
    return had;
}

bool takeLastLabelForFirst(Scene& scene)
{
    const auto last = static_cast<uint8_t>(scene.surface.materials.size() - 1);
    std::replace(scene.surface.labels.begin(), scene.surface.labels.end(), last, uint8_t{0});
    return last > 0;
}

bool dropResidual(Scene& scene)
{
    const bool had = !scene.surface.residual.empty();
    scene.surface.residual = {};
    return had;
}

bool trustBrdfWholly(Scene& scene)
{
    scene.surface.residual.trust = 1;
    return !scene.surface.residual.empty();
}

// The pictures of the first two exchanged, which lie side by side in each texel.
bool exchangeComponents(Scene& scene)
{
    ResidualLayer& layer = scene.surface.residual;
    for (size_t pixel = 0; layer.components > 1 && pixel < layer.pixelCount(); ++pixel) {
        std::swap(layer.codes[pixel * kComponentsPerTexel], layer.codes[pixel * kComponentsPerTexel + 1]);
    }
    return layer.components > 1;
}

Image withoutGamma(const Image& picture)
{
    Image linear = picture;
    for (float& value : linear.values) {
        value = std::round(255 * linearFromSrgb(value)) / 255;
    }
    return linear;
}

Image colourChannelsExchanged(const Image& picture)
{
    Image exchanged = picture;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::vec3 v = picture.rgb(x, y);
            exchanged.setRgb(x, y, {v.z, v.y, v.x});
        }
    }
    return exchanged;
}

Image upsideDown(const Image& picture)
{
    Image turned = picture;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            turned.setRgb(x, y, picture.rgb(x, picture.height - 1 - y));
        }
    }
    return turned;
}

} // namespace

const std::vector<SceneMutant>& sceneMutants()
{
    static const std::vector<SceneMutant> mutants = {{"half texel misplaced", misplaceHalfTexel},
                                                     {"phiD mirrored", mirrorPhiD},
                                                     {"lights upside down", flipLights},
                                                     {"cosine dropped", dropCosine},
                                                     {"albedo ignored", ignoreAlbedo},
                                                     {"one label taken for another", takeLastLabelForFirst},
                                                     {"residual layer dropped", dropResidual},
                                                     {"BRDF trusted wholly", trustBrdfWholly},
                                                     {"components exchanged", exchangeComponents}};
    return mutants;
}

const std::vector<PictureMutant>& pictureMutants()
{
    static const std::vector<PictureMutant> mutants = {{"no gamma", withoutGamma},
                                                       {"red and blue exchanged", colourChannelsExchanged},
                                                       {"rows upside down", upsideDown}};
    return mutants;
}

} // namespace nacre::test
