#include "assets/synth/synth_capture.h"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assets/synth/calibration_spheres.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

std::string extensionOf(SynthFormat format)
{
    return format == SynthFormat::exr ? ".exr" : ".png";
}

// Names of a synthetic capture's files. Photographs count from 1, with as many digits as the last of them needs.
std::string numberedName(const SynthOptions& options, const std::string& what, size_t index)
{
    const size_t digits = std::max<size_t>(2, std::to_string(options.lights).size());
    return fmt::format("{}_{:0{}}", what, index + 1, digits);
}

std::string photographFile(const SynthOptions& options, const std::string& what, size_t index)
{
    return numberedName(options, what, index) + extensionOf(options.format);
}

// Members of a bracket are told apart by a letter, a for the first.
std::string exposureFile(const SynthOptions& options, size_t index, size_t exposure)
{
    if (options.exposures.size() == 1) {
        return photographFile(options, "object", index);
    }
    return fmt::format("{}_{}{}", numberedName(options, "object", index), static_cast<char>('a' + exposure),
                       extensionOf(options.format));
}

using Json = nlohmann::ordered_json;

Json jsonOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

Json jsonOf(const Light& light)
{
    return {{"direction", jsonOf(light.direction)}, {"irradiance", jsonOf(light.irradiance)}};
}

Json photographDocument(const SynthScene& scene, size_t index)
{
    const SynthOptions& options = scene.options;
    Json photograph;
    if (options.exposures.size() == 1) {
        photograph["file"] = exposureFile(options, index, 0);
        photograph["exposureSeconds"] = options.exposures[0];
    } else {
        for (size_t e = 0; e < options.exposures.size(); ++e) {
            photograph["exposures"].push_back(
                {{"file", exposureFile(options, index, e)}, {"seconds", options.exposures[e]}});
        }
    }
    if (options.giveLights) {
        Light light = scene.lights[index];
        light.direction *= options.lightDistance > 0 ? static_cast<float>(options.lightDistance) : 1.0f;
        photograph["light"] = jsonOf(light);
    }
    return photograph;
}

Json sphereDocument(const SynthOptions& options, const std::string& what)
{
    Json sphere;
    for (int i = 0; i < options.lights; ++i) {
        sphere["photographs"].push_back(photographFile(options, what, i));
    }
    sphere["mask"] = what + "_mask.png";
    return sphere;
}

Json parametersOf(const LambertGgx& m)
{
    return {
        {"model", "lambert+ggx"}, {"diffuse", jsonOf(m.diffuse)}, {"specular", jsonOf(m.specular)}, {"alpha", m.alpha}};
}

Json parametersOf(const AbcModel& m)
{
    return {{"model", "abc"}, {"kD", jsonOf(m.kD)}, {"A", jsonOf(m.A)}, {"B", m.B}, {"C", m.C}, {"ior", m.ior}};
}

// Measured materials have no parameters: their file's name, in "material", says what they are.
Json parametersOf(const std::shared_ptr<const BrdfTable>&)
{
    return {{"model", "table"}};
}

Json parametersOf(const std::shared_ptr<const RglBrdf>&)
{
    return {{"model", "RGL database"}};
}

Json parametersOf(const SgdModel& m)
{
    return {{"model", "sgd"},           {"rhoD", jsonOf(m.rhoD)}, {"rhoS", jsonOf(m.rhoS)},
            {"alpha", jsonOf(m.alpha)}, {"p", jsonOf(m.p)},       {"F0", jsonOf(m.F0)},
            {"F1", jsonOf(m.F1)},       {"kap", jsonOf(m.kap)},   {"lambda", jsonOf(m.lambda)},
            {"c", jsonOf(m.c)},         {"k", jsonOf(m.k)},       {"theta0", jsonOf(m.theta0)}};
}

Json parametersOfModel(const BrdfModel& model)
{
    return std::visit([](const auto& m) { return parametersOf(m); }, model);
}

std::string nameOf(SynthShape shape)
{
    return shape == SynthShape::sphere ? "sphere" : shape == SynthShape::bowl ? "bowl" : "bumpy";
}

std::string textOf(const Json& json)
{
    return json.dump(2) + "\n";
}

// The JSON files of a synthetic capture (docs/formats.md), as text.
std::string captureDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre capture"}, {"version", 1},       {"name", nameOf(scene.options.shape)},
              {"transfer", "linear"},      {"mask", "mask.png"}, {"truthNormals", "truth/normals.exr"}};
    if (scene.options.giveLights && scene.options.lightDistance > 0) {
        json["objectWidth"] = 1; // the lights' vectors are their places
    }
    if (scene.options.giveLights && scene.options.fieldOfView > 0) {
        json["fieldOfView"] = scene.options.fieldOfView;
    }
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        json["photographs"].push_back(photographDocument(scene, i));
    }
    json["mirrorSphere"] = sphereDocument(scene.options, "mirror");
    json["diffuseSphere"] = sphereDocument(scene.options, "diffuse");
    return textOf(json);
}

std::string lightsDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre lights"}, {"version", 1}};
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        Json light = jsonOf(scene.lights[i]);
        light["photograph"] = exposureFile(scene.options, i, 0);
        json["lights"].push_back(light);
    }
    return textOf(json);
}

std::string brdfDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre brdf"},
              {"version", 1},
              {"material", scene.options.material},
              {"parameters", parametersOfModel(scene.models[0])},
              {"radianceScale", scene.sensor.gain},
              {"noise", scene.sensor.noise},
              {"diffuseSphereReflectance", jsonOf(scene.options.sphereReflectance)},
              {"seed", scene.options.seed}};
    if (scene.options.bounces > 0) {
        json["bounces"] = scene.options.bounces;
    }
    for (size_t i = 0; i < scene.options.patches.size(); ++i) {
        json["patches"].push_back(
            {{"material", scene.options.patches[i]}, {"parameters", parametersOfModel(scene.models[i + 1])}});
    }
    return textOf(json);
}

// Share of full scale that the mirror sphere shows of the dark room.
constexpr double kRoomValue = 0.01;

// What a photograph shows; with its number it tells the noise of one picture from another's.
enum Subject : uint64_t { kObject, kMirror, kDiffuse, kSubjects };

uint64_t noiseStream(Subject subject, size_t light, size_t exposure)
{
    return (light * kSubjects + subject) * 64 + exposure;
}

void saveMask(const fs::path& file, const std::vector<uint8_t>& mask, int width, int height)
{
    Image picture(width, height, 1);
    for (size_t i = 0; i < mask.size(); ++i) {
        picture.values[i] = mask[i];
    }
    saveImage(file, picture, PixelType::uint8);
}

// Evenly spaced grey levels up to white for the materials in turn, black beside the object.
void saveLabels(const fs::path& file, const SynthScene& scene)
{
    Image picture(scene.options.width, scene.options.height, 1);
    for (const uint32_t pixel : scene.view.seen) {
        picture.values[pixel] = static_cast<float>(scene.labels[pixel] + 1) / static_cast<float>(scene.models.size());
    }
    saveImage(file, picture, PixelType::uint8);
}

void savePhotograph(const fs::path& file, const Image& photograph, SynthFormat format)
{
    saveImage(file, photograph, format == SynthFormat::exr ? PixelType::float32 : PixelType::uint16);
}

void writeObject(const fs::path& folder, const SynthScene& scene, size_t i)
{
    const Image radiance = objectRadiance(scene, scene.lights[i], 1);
    for (size_t e = 0; e < scene.options.exposures.size(); ++e) {
        Image photograph = exposed(radiance, scene.sensor, scene.options.exposures[e], noiseStream(kObject, i, e));
        savePhotograph(folder / exposureFile(scene.options, i, e), photograph, scene.options.format);
    }
    if (scene.options.shadowMasks) {
        saveMask(folder / "truth" / (numberedName(scene.options, "shadow", i) + ".png"),
                 litPixels(scene, scene.lights[i], 1), scene.options.width, scene.options.height);
    }
}

// The mirror's highlight clips in every format: no lamp fits into the exposure of what it lights.
void writeSpheres(const fs::path& folder, const SynthScene& scene, size_t i)
{
    const SynthOptions& options = scene.options;
    Sensor clipping = scene.sensor;
    clipping.clips = true;
    Image mirror = mirrorSphereRadiance(options.sphereSize, scene.lights[i], kRoomValue / scene.sensor.gain);
    savePhotograph(folder / photographFile(options, "mirror", i),
                   exposed(mirror, clipping, 1.0, noiseStream(kMirror, i, 0)), options.format);
    Image diffuse = diffuseSphereRadiance(options.sphereSize, options.sphereReflectance, scene.lights[i]);
    savePhotograph(folder / photographFile(options, "diffuse", i),
                   exposed(diffuse, scene.sensor, 1.0, noiseStream(kDiffuse, i, 0)), options.format);
}

void writePhotographs(const fs::path& folder, const SynthScene& scene)
{
    parallelFor(scene.lights.size(), 1, scene.options.threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            writeObject(folder, scene, i);
            writeSpheres(folder, scene, i);
        }
    });
}

void writeMasks(const fs::path& folder, const SynthScene& scene)
{
    saveMask(folder / "mask.png", scene.view.mask, scene.options.width, scene.options.height);
    const int size = scene.options.sphereSize;
    saveMask(folder / "mirror_mask.png", calibrationSphereMask(size), size, size);
    saveMask(folder / "diffuse_mask.png", calibrationSphereMask(size), size, size);
}

void writeTruth(const fs::path& folder, const SynthScene& scene)
{
    saveNormalMap(folder / "normals.exr", scene.view.normals);
    if (scene.models.size() > 1) {
        saveLabels(folder / "labels.png", scene);
    }
    writeTextFile(folder / "lights.json", lightsDocument(scene));
    writeTextFile(folder / "brdf.json", brdfDocument(scene));
}

void createFolder(const fs::path& folder)
{
    std::error_code error;
    if (!fs::create_directories(folder, error)) {
        throw Error(folder, "cannot be made: " + error.message(), "a writable place with room");
    }
}

} // namespace

void writeSynthCapture(const fs::path& folder, const SynthScene& scene, bool replace)
{
    WholeOutput output(folder, replace);
    if (fs::exists(folder) && !fs::exists(folder / "capture.json")) {
        throw Error(folder, "exists and is no capture", "a new name: captures alone are replaced");
    }
    const fs::path& temporary = output.temporary();
    createFolder(temporary / "truth");
    writeMasks(temporary, scene);
    writeTruth(temporary / "truth", scene);
    writePhotographs(temporary, scene);
    writeTextFile(temporary / "capture.json", captureDocument(scene));
    output.commit();
}

} // namespace nacre
