#include <memory>

#include <fmt/format.h>

#include "app/arguments/scene_options.h"
#include "app/commands/commands.h"
#include "app/materials/render_output.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/scene_names.h"
#include "engine/scene/scene_residual.h"

namespace nacre {

namespace {

struct RenderArguments {
    SceneOptions scene;
    std::filesystem::path output;
    bool force = false;
    bool quiet = false;
};

// Software devices are called as their driver is: not twice.
std::string describe(const DeviceInfo& device)
{
    const bool same = device.driver.starts_with(device.name.substr(0, device.name.find(' ')));
    return same ? device.driver : fmt::format("{} ({})", device.name, device.driver);
}

std::string describePath(Renderer& renderer)
{
    if (renderer.pathTaken() == RenderPath::direct) {
        const std::string reason = renderer.whyDirect();
        return reason.empty() ? "direct" : "direct: " + reason;
    }
    std::string sizes;
    for (const BallSize& size : renderer.ballSizes()) {
        sizes += fmt::format("{}{} texels, shown at {}", sizes.empty() ? "" : "; ", size.radiance, size.display);
    }
    return fmt::format("ball ({}), {:.1f} MiB cached", sizes, renderer.cachedBytes() / 1048576.0);
}

std::string describeDrawing(Renderer& renderer, const RenderOutput& output)
{
    return output.isRadiance    ? "direct: EXR holds radiance"
           : output.isExposed() ? describePath(renderer)
                                : "none: false colours need no lookup";
}

void report(const Scene& scene, Renderer& renderer, const RenderOutput& output, const RenderedOutput& rendered)
{
    noteUnmeasured(scene);
    const NormalMap& normals = scene.surface.normals;
    fmt::print("rendered     {}x{} pixels under {} light{}", normals.width, normals.height, scene.lights.size(),
               scene.lights.size() == 1 ? "" : "s");
    fmt::print("{}\ndevice       {}\n", output.frames == 1 ? "" : fmt::format(", {} frames", output.frames),
               describe(renderer.context().info()));
    fmt::print("path         {}\nmemory       {:.1f} MiB on the device\n", describeDrawing(renderer, output),
               renderer.deviceBytes() / 1048576.0);
    if (!scene.surface.horizon.empty()) {
        fmt::print("shadows      cast by the height, {} azimuths\n", scene.surface.horizon.azimuths);
    }
    if (hasResidualFrom(scene.surface, scene.view)) {
        fmt::print("residual     {} components, {}\n", scene.surface.residual.components, nameOf(output.residual));
    }
    if (output.isExposed()) {
        fmt::print("exposure     {:+.2f} stops{}\n", rendered.stops, output.exposure ? "" : " (automatic)");
    }
    fmt::print("wrote        {}{}\n", rendered.first.string(),
               output.frames > 1 && !output.isAnimation ? " and so on" : "");
}

void runRender(const RenderArguments& arguments)
{
    const SceneDescription description = arguments.scene.description();
    const RenderOutput output = checkedOutput(description, arguments.output, arguments.force);
    requireConsistent(description);
    const Context context(arguments.scene.device);
    const Scene scene = loadScene(description, arguments.scene.fits, context, arguments.quiet);
    Renderer renderer(context);
    renderer.setSurface(scene.surface);
    renderer.setView(scene.view);
    const RenderedOutput rendered = renderFrames(renderer, output, scene);
    if (!arguments.quiet) {
        report(scene, renderer, output, rendered);
    }
}

} // namespace

void addRenderCommand(CLI::App& app)
{
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "A surface, or its material on other normals, under any lights");
    SceneOptions& scene = arguments->scene;
    scene.addTo(*command,
                {.material = "In place of SURFACE, with --onto: FILE.binary (MERL), FILE.bsdf (RGL), FILE.exr (our "
                             "table), NAME.nacre[#MATERIAL], or a model as synth takes it",
                 .onto = "Put the first material onto these camera-frame normals: .exr, .png (16-bit best; n = 2v - 1, "
                         "black = no data) or another NAME.nacre; a tangent-space map makes a flat piece seen from the "
                         "front",
                 .light = "x,y,z[,r,g,b]: direction towards the light (x right, y up, z towards the camera), "
                          "irradiance (default 1); or captured:N; soft:DEGREES: before it spreads it. Repeatable "
                          "(default: captured:1)",
                 .environment = "Light from all around: latitude-longitude picture, .exr or .hdr, +z in its middle",
                 .exposure = "Stops, not on EXR (default: the 99th percentile of radiance at 0.9)",
                 .show =
                     "picture, normals, labels, coverage (stripes where something unmeasured is asked for), theta-h "
                     "or theta-d (of the brightest light) [picture]",
                 .residual = "What the captured surface shows beyond its BRDF, where acquire kept it: on, off, or "
                             "alone about middle grey [on]",
                 .state = "JSON file whose keys are these options; the command line wins (docs/formats.md)"});
    scene.add<int>(*command, "--environment-lights", &SceneDescription::environmentLights,
                   "At most so many directional lights stand for it (default: 256)");
    scene.add<std::string>(*command, "--rig", &SceneDescription::rig,
                           "Lights by name: key, three-point, raking, ring, environment; or those of a file, as nacre "
                           "calibrate writes it (docs/formats.md)");
    scene.add<float>(*command, "--environment-turn", &SceneDescription::environmentTurn,
                     "Degrees about the vertical axis");
    scene.addParsed(*command, "--view", &SceneDescription::view, viewFromText,
                    "x,y,z towards another distant viewer of the same normals (default: 0,0,1)");
    scene.addParsed(*command, "--path", &SceneDescription::path, pathFromName,
                    "auto, direct (a table lookup per pixel and light) or ball (one lookup a pixel) [auto]");
    scene.addParsed(*command, "--tone", &SceneDescription::toneCurve, toneCurveFromName,
                    "Tone curve, not on EXR: srgb or filmic [srgb]");
    scene.addFlag(
        *command, "--shadows,!--no-shadows", &SceneDescription::shadows,
        "The height casts shadows, where NAME.nacre has one; a captured surface's is integrated from its normals");
    scene.add<int>(*command, "--frames", &SceneDescription::frames,
                   "A sequence of so many: NAME_0001.png and so on, or one .webp of 25 a second");
    scene.addParsed(*command, "--motion", &SceneDescription::motion, motionFromName,
                    "How lights move over --frames: turntable (about the view), sweep (left to right), none "
                    "[turntable]");
    command
        ->add_option("-o,--output", arguments->output,
                     "Picture to write: .png (8-bit sRGB), .exr (linear) or .webp (lossless, animated)")
        ->required();
    command->add_flag("--force", arguments->force, "Replace an output that exists");
    command->add_flag("--quiet", arguments->quiet, "Print nothing");
    command->footer("Example:\n  nacre render horse.nacre --light=-0.5,0.3,1 --light 0.6,0,1,1,0.8,0.6 --size 640x480 "
                    "-o horse.png\n  nacre render horse.nacre --onto cloth.exr -o cloth.exr\n"
                    "  nacre render --material paper_white_rgb.bsdf --onto cloth.exr -o paper.png\n"
                    "  nacre render horse.nacre --environment studio.hdr --frames 48 -o horse.webp");
    command->callback([arguments] { runRender(*arguments); });
}

} // namespace nacre
