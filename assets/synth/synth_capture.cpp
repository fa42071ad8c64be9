#include "assets/synth/synth_capture.h"

#include "assets/synth/calibration_spheres.h"
#include "assets/synth/synth_documents.h"
#include "assets/synth/synth_names.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

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
        throw Error(folder, "exists and is no capture", "a new name; --force replaces captures alone");
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
