#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "app/arguments/scene_options.h"
#include "app/commands/commands.h"
#include "app/materials/render_output.h"
#include "app/materials/target_source.h"
#include "engine/files/error.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/scene_names.h"
#include "engine/scene/scene_residual.h"
#include "engine/target/mesh_raster.h"

namespace nacre {

namespace {

struct RenderArguments {
    SceneOptions scene;
    std::filesystem::path output;
    float scale = 1;
    bool hasScaleBar = false;
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
    noteUncertain(scene);
    const NormalMap& normals = scene.surface.normals;
    const glm::ivec2 size = wholeZoom(normals.width, normals.height, output.scale).size;
    fmt::print("rendered     {}x{} pixels under {} light{}", size.x, size.y, scene.lights.size(),
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

// Degrees that the object has turned after a share of the frames. Of a relief only the front is known: it sways.
float turnedBy(const Mesh& mesh, float share)
{
    constexpr float kReliefSway = 40, kStep = 1.0f / 1024; // halfway it stands as it is, to the bit
    return mesh.front ? kStep * std::round(kReliefSway / kStep * std::sin(glm::two_pi<float>() * share)) : 360 * share;
}

// Gives the renderer what the camera sees of a mesh, or a relief, that turns over the frames; none: no object turns.
std::function<void(int)> turningObject(const SceneDescription& scene, const SceneInputs& inputs, const Context& context,
                                       Renderer& renderer)
{
    if (scene.motion != LightMotion::object) {
        return {};
    }
    const std::shared_ptr<const Mesh> mesh = loadSurfaceOrMesh(scene, inputs, context, true).mesh;
    if (mesh->front && scene.residual == ResidualUse::alone) {
        throw Error(scene.surface, "has a residual layer from the front alone", "another motion, or no layer alone",
                    Error::kUsage);
    }
    const std::shared_ptr<MeshRaster> raster = meshRasterFor(context, mesh, scene);
    return [scene, raster, &renderer](int frame) {
        SceneDescription turned = scene;
        turned.turn.yaw += turnedBy(*raster->mesh(), static_cast<float>(frame) / static_cast<float>(scene.frames));
        Surface pixels;
        drawMesh(*raster, turned, pixels);
        renderer.setPixels(pixels);
    };
}

void runRender(const RenderArguments& arguments)
{
    const SceneDescription description = arguments.scene.description();
    const RenderOutput output =
        checkedOutput(description, arguments.output, arguments.scale, arguments.hasScaleBar, arguments.force);
    requireConsistent(description);
    const Context context(arguments.scene.device);
    const SceneInputs inputs = sceneInputs(arguments.scene.fits);
    const Scene scene = loadScene(description, inputs, context, arguments.quiet);
    Renderer renderer(context);
    renderer.setSurface(scene.surface);
    renderer.setView(scene.view);
    const RenderedOutput rendered =
        renderFrames(renderer, output, scene, turningObject(description, inputs, context, renderer));
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
    scene.addTo(
        *command,
        {.material = "Material instead of SURFACE, for --onto: .binary (MERL), .bsdf (RGL), .exr, "
                     "NAME.nacre[#MATERIAL] or a model",
         .onto =
             "Shape for the first material: camera-frame or tangent-space normals (.exr, .png), NAME.nacre, a mesh or "
             "make:NAME",
         .light = "Light: direction x,y,z[,r,g,b] with irradiance [1]; captured:N; near:WIDTHS: in front of x,y,z puts "
                  "it so many widths of the object away; soft:DEGREES: in front spreads it. Repeatable (default: "
                  "captured:1)",
         .environment = "Latitude-longitude picture of the light from all around, .exr or .hdr",
         .exposure = "Exposure in stops, not for .exr (default: 99th percentile of radiance at 0.9)",
         .show = "Content: picture, normals, labels, coverage (stripes where uncertain by over 20 %), theta-h or "
                 "theta-d of "
                 "the brightest light [picture]",
         .layer = "Residual layer of the captured surface: on, off, or alone about middle grey [on]",
         .state = "JSON file whose keys are these options; the command line takes precedence"});
    scene.add<std::string>(*command, "--rig", &SceneDescription::rig,
                           "Lights by name: key, three-point, raking, ring, environment; or a file of lights");
    scene
        .add<int>(*command, "--environment-lights", &SceneDescription::environmentLights,
                  "Largest number of directional lights for --environment (default: 256)")
        ->group("Lights");
    scene
        .add<float>(*command, "--environment-turn", &SceneDescription::environmentTurn,
                    "Turn of --environment about the vertical axis in degrees (default: 0)")
        ->group("Lights");
    scene
        .addParsed(*command, "--view", &SceneDescription::view, viewFromText,
                   "Direction x,y,z towards the viewer (default: 0,0,1)")
        ->group("Picture");
    scene
        .addParsed(*command, "--path", &SceneDescription::path, pathFromName,
                   "Lookups: direct (one per pixel and light), ball (one per pixel) or auto [auto]")
        ->group("Picture");
    scene
        .addParsed(*command, "--tone", &SceneDescription::toneCurve, toneCurveFromName,
                   "Tone curve, not for .exr: srgb or filmic [srgb]")
        ->group("Picture");
    scene
        .addFlag(*command, "--shadows,!--no-shadows", &SceneDescription::shadows,
                 "Cast shadows, from the height of the surface or from its integrated normals")
        ->group("Picture");
    scene
        .add<int>(*command, "--frames", &SceneDescription::frames,
                  "Number of frames: NAME_0001.png and so on, or one .webp of 25 a second")
        ->group("Picture");
    scene
        .addParsed(*command, "--motion", &SceneDescription::motion, motionFromName,
                   "Motion over --frames: of the lights, turntable (about the view) or sweep (left to right); of the "
                   "mesh of --onto or of the relief, which sways, "
                   "object; none [turntable]")
        ->group("Picture");
    command
        ->add_option("--scale", arguments->scale,
                     "Scale of the picture after --size, up to 64: above 1 normals are filtered before they are "
                     "shaded, below 1 what is shaded is averaged (default: 1)")
        ->group("Picture");
    command
        ->add_flag("--scale-bar", arguments->hasScaleBar,
                   "Bar of a round length in millimetres, for surfaces acquired with --pixels-per-mm")
        ->group("Picture");
    command
        ->add_option("-o,--output", arguments->output,
                     "Picture to write: .png (8-bit sRGB), .exr (linear) or .webp (lossless, animated)")
        ->option_text("OUT.png|OUT.exr|OUT.webp")
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
