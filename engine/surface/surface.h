#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/brdf/brdf_table.h"
#include "engine/brdf/compact_brdf.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"
#include "engine/surface/horizon.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/residual_layer.h"

namespace nacre {

struct Material {
    std::string name;
    BrdfTable table;
    Coverage coverage; // empty where the table was not measured, or is a smaller model's
    // The smaller model that the table was made of; empty where the table itself is the model.
    std::optional<CompactBrdf> compact{};
};

// Of its model in memory, coverage apart: the smaller one, or the table in 32-bit floats.
size_t bytesOf(const Material& material);

// relative: the BRDF is 1/sr up to one factor per capture. absolute: the diffuse sphere's reflectance was given.
enum class RadianceScale { relative, absolute };

// One captured light and the photograph that it lit.
struct CapturedLight {
    std::string photograph; // name, for the user
    Light light;
};

// What an acquisition or nacre target writes: a folder NAME.nacre. A target has no materials; its labels then are
// indices into parts.
struct Surface {
    static constexpr uint8_t kNoMaterial = 255;

    NormalMap normals;
    Image albedo;                // RGB factor about 1 over each material's pixels; empty = 1 everywhere
    std::vector<uint8_t> labels; // index into materials per pixel, kNoMaterial outside
    std::vector<Material> materials;
    std::vector<std::string> parts; // names of a target's labels; empty where materials name them
    // One channel: pixels of the map towards the viewer, up to a constant for each connected piece, 0 where there is no
    // normal. Empty: not known.
    Image height;
    bool castsShadows = false; // the height was found to explain the photographs' shadows: it casts them unless unasked
    ResidualLayer residual;    // of the captured photographs; empty: the BRDF is all
    HorizonMap horizon;        // of the height, for cast shadows; empty: lights reach all that faces them. In no file
    std::vector<glm::vec3> places; // pixelPlaces, where they are known; in no file
    // Where the camera stands, as places are. None: far away, so that it sees along z.
    std::optional<glm::vec3> camera;
    std::vector<CapturedLight> lights;
    std::string transfer; // of the photographs: linear or srgb; empty: not known, or as they declare it themselves
    RadianceScale scale = RadianceScale::relative;
    std::optional<double> pixelsPerMillimetre{}; // of the object, which is as large as it was photographed
    // dB of the photographs, each predicted from the others, mean over them (acquire); empty: not known.
    std::optional<double> leftOutDecibels{};
};

// Whether the pixel has a normal and a material.
inline bool isShaded(const Surface& surface, size_t pixel)
{
    return surface.normals.confidence[pixel] > 0 && surface.labels[pixel] < surface.materials.size();
}

inline glm::vec3 albedoFactor(const Surface& surface, size_t pixel)
{
    const float* a = surface.albedo.values.empty() ? nullptr : &surface.albedo.values[3 * pixel];
    return a == nullptr ? glm::vec3(1) : glm::vec3(a[0], a[1], a[2]);
}

inline constexpr const char* kSurfaceDescription = "surface.json";

// surface.json, normals.exr, labels.png, albedo.exr (where estimated), height.exr (where known), material_N.exr and
// material_N_coverage.exr, residual_NN.png and residual_weights.exr (where there is a residual layer).
// Written into a temporary folder, then renamed; an existing folder is refused without `replace`.
void saveSurface(const std::filesystem::path& folder, const Surface& surface, bool replace);
Surface loadSurface(const std::filesystem::path& folder);

// The surface of `normals` wholly made of one material, albedo 1: material transfer.
Surface transferredSurface(const NormalMap& normals, const Material& material);
// The same of another surface's normals, height and horizon.
Surface transferredSurface(const Surface& target, const Material& material);

// The same surface in a picture of another size: fittedNormalMap, with albedo factors, labels, height, residual
// layer and horizon alike.
Surface fittedSurface(const Surface& surface, int width, int height);

// The pixels alone (normals, labels, albedo factors, residual layer, places; no materials) of at most `most` of the
// surface's pixels that have a normal and a material: all of them, or evenly spaced ones in reading order. Packed into
// a picture near to square.
Surface sampledPixels(const Surface& surface, size_t most);

} // namespace nacre
