#include "engine/exchange/gltf_surface.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "engine/exchange/relief_mesh.h"
#include "engine/files/whole_file.h"
#include "engine/surface/object_places.h"
#include "shared/lens.h"
#include "shared/shading.h"

namespace nacre {
namespace {

std::string pngOf(const Image& codes)
{
    const TemporaryFolder folder; // picture writers want a file
    saveImage(folder.path() / "texture.png", codes, PixelType::uint8);
    return readWholeFile(folder.path() / "texture.png", "a picture");
}

// Packed pictures: value(pixel) is asked for shaded pixels; others have the value of the nearest one to their left or
// right, so that filters do not pull their border towards black.
template <class Value> Image picture(const Surface& surface, int channels, const Value& value)
{
    const int width = surface.normals.width, height = surface.normals.height;
    Image codes(width, height, channels);
    for (int y = 0; y < height; ++y) {
        const auto copy = [&](int from, int to) {
            std::copy_n(&codes.values[codes.index(from, y)], channels, &codes.values[codes.index(to, y)]);
        };
        int last = -1;
        for (int x = 0; x < width; ++x) {
            if (isShaded(surface, surface.normals.index(x, y))) {
                value(surface.normals.index(x, y), &codes.values[codes.index(x, y)]);
                for (int back = last < 0 ? 0 : x; back < x; ++back) {
                    copy(x, back);
                }
                last = x;
            } else if (last >= 0) {
                copy(last, x);
            }
        }
    }
    return codes;
}

class Packer {
public:
    Packer(const Surface& surface, const std::vector<SurfaceLobes>& lobes, GltfScene& scene)
        : surface_(surface), lobes_(lobes), scene_(scene)
    {
        float ior = 1.5f;
        for (const SurfaceLobes& l : lobes) {
            const LobeColours c = l.colours;
            if (!l.shape.isMetal() && l.shape.specularWeight > 0) {
                ior = std::max(
                    ior, gltfIorOf(std::max({c.specular.x, c.specular.y, c.specular.z}) / l.shape.specularWeight));
            }
        }
        for (size_t i = 0; i < lobes.size(); ++i) {
            materials_.push_back(gltfMaterialOf(surface.materials[i].name, lobes[i].shape, lobes[i].colours, ior));
        }
    }

    // Factors where one value will do for all, textures else.
    void pack()
    {
        GltfMaterial& to = scene_.material;
        to = materials_.front();
        for (size_t i = 1; i < materials_.size(); ++i) {
            to.name += ", " + materials_[i].name;
        }
        to.isCut = true;
        packNormals();
        packColour(&GltfMaterial::baseColor, to.baseColorTexture, true);
        const bool hasDielectric = any([](const GltfMaterial& m) { return m.metallic == 0; });
        if (hasDielectric && (materials_.size() > 1 || !surface_.albedo.values.empty())) {
            packColour(&GltfMaterial::specularColor, to.specularColorTexture, false);
        }
        if (any([](const GltfMaterial& m) { return m.sheenColor != glm::vec3(0); })) {
            packSheen();
        }
        if (materials_.size() > 1) {
            packSeveral();
        }
    }

private:
    template <class Test> bool any(const Test& test) const
    {
        return std::any_of(materials_.begin(), materials_.end(), test);
    }
    const GltfMaterial& of(size_t pixel) const { return materials_[surface_.labels[pixel]]; }
    int add(const Image& codes)
    {
        scene_.images.push_back(pngOf(codes));
        return static_cast<int>(scene_.images.size()) - 1;
    }
    // Albedo factor over the largest that its material was fitted for.
    glm::vec3 factor(size_t pixel) const
    {
        return glm::min(albedoFactor(surface_, pixel) / lobes_[surface_.labels[pixel]].most, glm::vec3(1));
    }

    void packNormals()
    {
        scene_.material.normalTexture = add(picture(surface_, 3, [&](size_t pixel, float* code) {
            for (int c = 0; c < 3; ++c) {
                code[c] = 0.5f + 0.5f * surface_.normals.normals[pixel][c];
            }
        }));
    }

    // A colour times the albedo factor, sRGB, divided by its largest value, which becomes the factor.
    void packColour(glm::vec3 GltfMaterial::*colour, std::optional<int>& texture, bool withAlpha)
    {
        const auto valueOf = [&](size_t pixel) {
            const bool isUnused = colour == &GltfMaterial::specularColor && of(pixel).metallic == 1;
            const float most = lobes_[surface_.labels[pixel]].most;
            return isUnused ? glm::vec3(0) : factor(pixel) * (most * of(pixel).*colour);
        };
        glm::vec3 largest(1e-6f);
        for (size_t pixel = 0; pixel < surface_.labels.size(); ++pixel) {
            if (isShaded(surface_, pixel)) {
                largest = glm::max(largest, valueOf(pixel));
            }
        }
        if (withAlpha) {
            largest = glm::min(largest, glm::vec3(1)); // glTF's bound of baseColorFactor
        }
        Image codes = picture(surface_, withAlpha ? 4 : 3, [&](size_t pixel, float* code) {
            const glm::vec3 value = valueOf(pixel) / largest;
            for (int c = 0; c < 3; ++c) {
                code[c] = srgbFromLinear(value[c]);
            }
        });
        for (size_t pixel = 0; withAlpha && pixel < surface_.labels.size(); ++pixel) {
            codes.values[4 * pixel + 3] = isShaded(surface_, pixel) ? 1.0f : 0.0f;
        }
        scene_.material.*colour = largest;
        texture = add(codes);
    }

    void packSheen()
    {
        if (materials_.size() == 1 && surface_.albedo.values.empty()) {
            return;
        }
        packColour(&GltfMaterial::sheenColor, scene_.material.sheenColorTexture, false);
        if (materials_.size() > 1) {
            scene_.material.sheenRoughness = 1;
            scene_.material.sheenRoughnessTexture = add(alpha(&GltfMaterial::sheenRoughness));
        }
    }

    Image alpha(float GltfMaterial::*number) const
    {
        return picture(surface_, 4, [&](size_t pixel, float* code) { code[3] = of(pixel).*number; });
    }

    void packSeveral()
    {
        GltfMaterial& to = scene_.material;
        to.metallic = to.roughness = 1;
        to.metallicRoughnessTexture = add(picture(surface_, 3, [&](size_t pixel, float* code) {
            code[1] = of(pixel).roughness, code[2] = of(pixel).metallic;
        }));
        if (any([](const GltfMaterial& m) { return m.specular != 1; })) {
            to.specular = 1;
            to.specularTexture = add(alpha(&GltfMaterial::specular));
        }
    }

    const Surface& surface_;
    const std::vector<SurfaceLobes>& lobes_;
    GltfScene& scene_;
    std::vector<GltfMaterial> materials_;
};

// The mean height of the shaded pixels about a vertex, 0 where there are none.
float heightAt(const Surface& surface, const Image& height, float x, float y, int reach)
{
    float sum = 0, count = 0;
    const int cx = static_cast<int>(std::lround(x)), cy = static_cast<int>(std::lround(y));
    for (int j = std::max(cy - reach, 0); j <= std::min(cy + reach - 1, height.height - 1); ++j) {
        for (int i = std::max(cx - reach, 0); i <= std::min(cx + reach - 1, height.width - 1); ++i) {
            if (isShaded(surface, surface.normals.index(i, j))) {
                sum += height.at(i, j), count += 1;
            }
        }
    }
    return count > 0 ? sum / count : 0;
}

bool hasShaded(const Surface& surface, float x0, float y0, float x1, float y1)
{
    for (int y = static_cast<int>(y0); y < std::min<int>(static_cast<int>(std::ceil(y1)), surface.normals.height);
         ++y) {
        for (int x = static_cast<int>(x0); x < std::min<int>(static_cast<int>(std::ceil(x1)), surface.normals.width);
             ++x) {
            if (isShaded(surface, surface.normals.index(x, y))) {
                return true;
            }
        }
    }
    return false;
}

GltfMesh relief(const Surface& surface, const Image& height, const GltfSurfaceOptions& options)
{
    const int width = height.width, rows = height.height;
    const float step = std::max(1.0f, static_cast<float>(std::max(width, rows)) / (options.largestGrid - 1));
    const int nx = static_cast<int>(std::ceil(width / step)) + 1, ny = static_cast<int>(std::ceil(rows / step)) + 1;
    const int reach = std::max(1, static_cast<int>(step / 2));
    const PictureMetres picture(surface.normals, height, options.width);
    const auto xOf = [&](int i) { return std::min(i * step, static_cast<float>(width)); };
    const auto yOf = [&](int j) { return std::min(j * step, static_cast<float>(rows)); };
    const glm::vec2 middle(extentOf(surface.normals).middle);
    const glm::vec4 viewpoint = viewpointOf(surface, kFrontView);
    std::vector<int> numbers(static_cast<size_t>(nx) * ny, -1);
    GltfMesh mesh;
    const auto vertex = [&](int i, int j) {
        int& known = numbers[static_cast<size_t>(j) * nx + i];
        if (known < 0) {
            known = static_cast<int>(mesh.positions.size());
            const float x = xOf(i), y = yOf(j);
            const float over = heightAt(surface, height, x, y, reach) - picture.middle.z;
            const glm::vec2 beside = glm::vec2(x - middle.x, middle.y - y) / picture.across;
            mesh.positions.push_back(picture.of(placeOnRay(viewpoint, beside, over / picture.across)));
            mesh.normals.emplace_back(0, 0, 1);
            mesh.tangents.emplace_back(1, 0, 0, 1);
            mesh.uvs.emplace_back(x / width, y / rows);
        }
        return static_cast<uint32_t>(known);
    };
    for (int j = 0; j + 1 < ny; ++j) {
        for (int i = 0; i + 1 < nx; ++i) {
            if (hasShaded(surface, xOf(i), yOf(j), xOf(i + 1), yOf(j + 1))) {
                const uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i, j + 1), d = vertex(i + 1, j + 1);
                mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
            }
        }
    }
    return mesh;
}

} // namespace

GltfScene gltfSurface(const Surface& surface, const Image& height, const std::vector<SurfaceLobes>& lobes,
                      const std::string& name, const GltfSurfaceOptions& options)
{
    GltfScene scene{.name = name, .mesh = relief(surface, height, options)};
    const int largest = std::max(surface.normals.width, surface.normals.height);
    if (largest > options.largestTexture) {
        const auto scaled = [&](int side) {
            return std::max(1, static_cast<int>(static_cast<int64_t>(side) * options.largestTexture / largest));
        };
        const Surface small = fittedSurface(surface, scaled(surface.normals.width), scaled(surface.normals.height));
        Packer(small, lobes, scene).pack();
    } else {
        Packer(surface, lobes, scene).pack();
    }
    return scene;
}

} // namespace nacre
