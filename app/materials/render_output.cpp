#include "app/materials/render_output.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/materials/scale_bar.h"
#include "engine/files/animation_file.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/scene/scene_residual.h"
#include "engine/surface/zoom.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kAnimation = ".webp";
constexpr float kMostScale = 64;
constexpr int kExposureFrames = 8; // of a sequence, to find one exposure for all

// One for all frames of an animation.
fs::path fileOfFrame(const fs::path& output, int frame, int frames)
{
    if (frames == 1 || lowerExtension(output) == kAnimation) {
        return output;
    }
    return output.parent_path() /
           fmt::format("{}_{:04}{}", output.stem().string(), frame + 1, output.extension().string());
}

std::vector<ImageAttribute> attributesOf(const DeviceInfo& device)
{
    return {{"Software", "nacre " NACRE_VERSION}, {"Device", device.name}, {"Driver", device.driver}};
}

// One exposure for the whole sequence, so that it does not flicker: that of its brightest frame.
float commonExposure(Renderer& renderer, const RenderOutput& output, const std::vector<Light>& lights,
                     const std::function<void(int)>& turnTo)
{
    const int probes = std::min(output.frames, kExposureFrames);
    float stops = 0;
    for (int i = 0; i < probes; ++i) {
        const int frame = i * output.frames / probes;
        renderer.setLights(movedLights(lights, output.motion, frame, output.frames));
        if (turnTo) {
            turnTo(frame);
        }
        const float wanted = renderer.automaticExposure();
        stops = i == 0 ? wanted : std::min(stops, wanted);
    }
    return stops;
}

// That EXR is not asked for what only pictures for the eye have.
void checkLook(const RenderOutput& output)
{
    if (output.isRadiance && (output.exposure || output.toneCurve != kToneSrgb)) {
        throw Error(output.file, "knows no exposure and no tone curve, EXR holds linear radiance",
                    "--exposure and --tone with a .png only", Error::kUsage);
    }
    if (output.isRadiance && output.path == RenderPath::ball) {
        throw Error(output.file, "is radiance, which balls for the display do not hold", "--path ball with .png",
                    Error::kUsage);
    }
    if (output.exposure && !std::isfinite(*output.exposure)) {
        throw Error("", "--exposure is not finite", "a number of stops", Error::kUsage);
    }
    if (output.show == Show::verdicts) {
        throw Error("", "--show verdicts needs the photographs", "nacre view SURFACE --capture FOLDER --show verdicts",
                    Error::kUsage);
    }
    if (output.isRadiance && output.show != Show::picture) {
        throw Error(output.file, "is radiance, which has no false colours", "--show with .png or .webp", Error::kUsage);
    }
    if (output.isRadiance && output.hasScaleBar) {
        throw Error(output.file, "is radiance, in which nothing is drawn", "--scale-bar with .png or .webp",
                    Error::kUsage);
    }
    if (output.isRadiance && output.residual == ResidualUse::alone) {
        throw Error(output.file, "is radiance, which is not drawn about middle grey",
                    "--layer alone with .png or .webp", Error::kUsage);
    }
}

} // namespace

RenderOutput checkedOutput(const SceneDescription& scene, const fs::path& file, float scale, bool hasScaleBar,
                           bool force)
{
    const std::string extension = lowerExtension(file);
    if (extension != ".png" && extension != ".exr" && extension != kAnimation) {
        throw Error(file, "is no picture that render writes",
                    ".png (8-bit sRGB) or .exr (linear radiance) or .webp (animated)", Error::kUsage);
    }
    if (scene.frames < 1 || scene.frames > kMostFrames) {
        throw Error("", fmt::format("--frames {} is out of range", scene.frames), fmt::format("1 to {}", kMostFrames),
                    Error::kUsage);
    }
    if (!(scale > 0 && scale <= kMostScale)) {
        throw Error("", fmt::format("--scale {} is out of range", scale),
                    fmt::format("above 0, at most {}", kMostScale), Error::kUsage);
    }
    const RenderOutput output{.file = file,
                              .frames = scene.frames,
                              .motion =
                                  scene.motion.value_or(scene.frames > 1 ? LightMotion::turntable : LightMotion::none),
                              .path = scene.path,
                              .exposure = scene.exposure,
                              .toneCurve = scene.toneCurve,
                              .show = scene.show,
                              .residual = scene.residual,
                              .scale = scale,
                              .hasScaleBar = hasScaleBar,
                              .isRadiance = extension == ".exr",
                              .isAnimation = extension == kAnimation};
    checkLook(output);
    for (int frame = 0; frame < output.frames; ++frame) {
        requireFile(fileOfFrame(file, frame, output.frames), force);
    }
    return output;
}

RenderedOutput renderFrames(Renderer& renderer, const RenderOutput& output, const Scene& scene,
                            const std::function<void(int frame)>& turnTo)
{
    const std::vector<ImageAttribute> attributes = attributesOf(renderer.context().info());
    std::optional<AnimationFile> animation;
    const NormalMap& pixels = scene.surface.normals;
    const Zoom zoom = wholeZoom(pixels.width, pixels.height, output.scale);
    if (output.scale != 1) {
        renderer.setZoom(zoom);
    }
    if (output.isAnimation) {
        animation.emplace(output.file, zoom.size.x, zoom.size.y);
    }
    if (output.hasScaleBar && !scene.surface.pixelsPerMillimetre) {
        throw Error("", "--scale-bar needs a surface whose pixels have a size",
                    "a surface acquired with --pixels-per-mm, not its material on another", Error::kUsage);
    }
    RenderedOutput rendered{.first = fileOfFrame(output.file, 0, output.frames)};
    renderer.setPath(output.path);
    renderer.setShow(output.show);
    renderer.setResidual(residualOfExposure(output.residual));
    if (output.isExposed()) {
        rendered.stops = output.exposure ? *output.exposure : commonExposure(renderer, output, scene.lights, turnTo);
        renderer.setDisplay({.exposureStops = rendered.stops, .toneCurve = output.toneCurve});
    }
    renderer.setResidual(output.residual);
    for (int frame = 0; frame < output.frames; ++frame) {
        renderer.setLights(movedLights(scene.lights, output.motion, frame, output.frames));
        if (turnTo) {
            turnTo(frame);
        }
        const fs::path file = fileOfFrame(output.file, frame, output.frames);
        if (output.isRadiance) {
            saveImage(file, renderer.radiance(), PixelType::float32, attributes);
            continue;
        }
        Image picture = renderer.picture();
        if (output.hasScaleBar) {
            drawScaleBar(picture, output.scale * *scene.surface.pixelsPerMillimetre);
        }
        if (animation) {
            animation->add(picture);
        } else {
            saveImage(file, picture, PixelType::uint8, attributes);
        }
    }
    if (animation) {
        animation->write();
    }
    return rendered;
}

} // namespace nacre
