#include <memory>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/materials/render_output.h"
#include "engine/loading/render_scene.h"
#include "engine/scene/scene_names.h"
#include "engine/scene/scene_residual.h"

namespace nacre {

namespace {

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

void report(const Scene& scene, Renderer& renderer, const RenderArguments& arguments, const RenderOutput& output,
            const RenderedOutput& rendered)
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
        fmt::print("exposure     {:+.2f} stops{}\n", rendered.stops, arguments.exposure ? "" : " (automatic)");
    }
    fmt::print("wrote        {}{}\n", rendered.first.string(),
               output.frames > 1 && !output.isAnimation ? " and so on" : "");
}

void runRender(RenderArguments arguments)
{
    completeFromState(arguments);
    const RenderOutput output = checkedOutput(arguments);
    checkSceneArguments(arguments);
    const Context context(arguments.device);
    const Scene scene = sceneFromArguments(arguments, context);
    Renderer renderer(context);
    renderer.setSurface(scene.surface);
    renderer.setView(scene.view);
    const RenderedOutput rendered = renderFrames(renderer, arguments, output, scene);
    if (!arguments.quiet) {
        report(scene, renderer, arguments, output, rendered);
    }
}

} // namespace

void addRenderCommand(CLI::App& app)
{
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "A surface, or its material on other normals, under any lights");
    command->add_option("SURFACE", arguments->surface, "Folder NAME.nacre of nacre acquire; or --material");
    command->add_option(
        "--material", arguments->material,
        "Material instead of SURFACE, for --onto: .binary (MERL), .bsdf (RGL), .exr, NAME.nacre[#MATERIAL] or a model");
    command
        ->add_option("--fits", arguments->fits,
                     "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)")
        ->group("Materials and shapes");
    command
        ->add_option("--light", arguments->lights,
                     "Light: direction x,y,z[,r,g,b] with irradiance [1]; captured:N; soft:DEGREES: in front spreads "
                     "it. Repeatable (default: captured:1)")
        ->allow_extra_args(false);
    command->add_option(
        "--onto", arguments->onto,
        "Shape for the first material: camera-frame or tangent-space normals (.exr, .png) or NAME.nacre");
    command->add_option("--normal-y", arguments->normalY, "Green of the normals of --onto: gl (up) or dx (down) [gl]")
        ->group("Materials and shapes");
    command->add_option("--size", arguments->size,
                        "Size in pixels that the surface is fitted into, WxH (default: its own)");
    command->add_option("--exposure", arguments->exposure,
                        "Exposure in stops, not for .exr (default: 99th percentile of radiance at 0.9)");
    command->add_option("--environment", arguments->environment,
                        "Latitude-longitude picture of the light from all around, .exr or .hdr");
    command
        ->add_option("--environment-lights", arguments->environmentLights,
                     "Largest number of directional lights for --environment (default: 256)")
        ->group("Lights");
    command->add_option("--rig", arguments->rig,
                        "Lights by name: key, three-point, raking, ring, environment; or a file of lights");
    command
        ->add_option("--environment-turn", arguments->environmentTurn,
                     "Turn of --environment about the vertical axis in degrees (default: 0)")
        ->group("Lights");
    command->add_option("--view", arguments->view, "Direction x,y,z towards the viewer (default: 0,0,1)")
        ->group("Picture");
    command
        ->add_option("--path", arguments->path,
                     "Lookups: direct (one per pixel and light), ball (one per pixel) or auto [auto]")
        ->group("Picture");
    command->add_option("--tone", arguments->tone, "Tone curve, not for .exr: srgb or filmic [srgb]")->group("Picture");
    command
        ->add_option("--show", arguments->show,
                     "Content: picture, normals, labels, coverage (stripes where not measured), theta-h or theta-d of "
                     "the brightest light [picture]")
        ->group("Picture");
    command
        ->add_option("--layer", arguments->residual,
                     "Residual layer of the captured surface: on, off, or alone about middle grey [on]")
        ->group("Picture");
    command
        ->add_flag_function(
            "--shadows,!--no-shadows", [arguments](int64_t count) { arguments->shadows = count > 0; },
            "Cast shadows, from the height of the surface or from its integrated normals")
        ->group("Picture");
    command
        ->add_option("--frames", arguments->frames,
                     "Number of frames: NAME_0001.png and so on, or one .webp of 25 a second")
        ->group("Picture");
    command
        ->add_option(
            "--motion", arguments->motion,
            "Motion of the lights over --frames: turntable (about the view), sweep (left to right), none [turntable]")
        ->group("Picture");
    command
        ->add_option("--state", arguments->state,
                     "JSON file whose keys are these options; the command line takes precedence")
        ->group("Running");
    command
        ->add_option("--device", arguments->device,
                     "Vulkan device: number or part of its name in nacre info (default: the first)")
        ->group("Running");
    command
        ->add_option("-o,--output", arguments->output,
                     "Picture to write: .png (8-bit sRGB), .exr (linear) or .webp (lossless, animated)")
        ->required();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages")->group("Running");
    command->footer("Example:\n  nacre render horse.nacre --light=-0.5,0.3,1 --light 0.6,0,1,1,0.8,0.6 --size 640x480 "
                    "-o horse.png\n  nacre render horse.nacre --onto cloth.exr -o cloth.exr\n"
                    "  nacre render --material paper_white_rgb.bsdf --onto cloth.exr -o paper.png\n"
                    "  nacre render horse.nacre --environment studio.hdr --frames 48 -o horse.webp");
    command->callback([arguments] { runRender(*arguments); });
}

} // namespace nacre
