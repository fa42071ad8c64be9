#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "app/commands.h"
#include "app/light_argument.h"
#include "app/size_argument.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/brdf_tabulation.h"
#include "engine/scene/error.h"
#include "engine/scene/material_specification.h"
#include "engine/scene/whole_file.h"

namespace nacre {

namespace {

struct RenderArguments {
    std::filesystem::path surface;
    std::string material; // in place of a surface's
    std::filesystem::path fits;
    std::vector<std::string> lights;
    std::filesystem::path onto;
    std::string normalY = "gl";
    std::string size;
    std::optional<float> exposure; // stops
    std::string device;
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

// The picture's kind follows from its extension: EXR keeps linear radiance, PNG is exposed for the eye.
bool isForTheEye(const RenderArguments& arguments)
{
    const std::string extension = arguments.output.extension().string();
    if (extension != ".png" && extension != ".exr") {
        throw Error(arguments.output, "is no picture that render writes", ".png (8-bit sRGB) or .exr (linear radiance)",
                    Error::kUsage);
    }
    if (extension == ".exr" && arguments.exposure) {
        throw Error(arguments.output, "knows no exposure, EXR holds linear radiance", "--exposure with a .png only",
                    Error::kUsage);
    }
    if (arguments.exposure && !std::isfinite(*arguments.exposure)) {
        throw Error("", "--exposure is not finite", "a number of stops", Error::kUsage);
    }
    return extension == ".png";
}

NormalY normalYOf(const RenderArguments& arguments)
{
    if (arguments.normalY != "gl" && arguments.normalY != "dx") {
        throw Error("", fmt::format("--normal-y {} is not known", arguments.normalY),
                    "gl (green points up) or dx (down)", Error::kUsage);
    }
    return arguments.normalY == "gl" ? NormalY::gl : NormalY::dx;
}

// A named material as a surface without pixels: --onto gives the normals.
Surface surfaceOfMaterial(const RenderArguments& arguments)
{
    const NamedBrdf named = parseMaterial(arguments.material, fitsFolderFrom(arguments.fits));
    const BrdfTable* table = tableOf(named.model);
    Surface surface;
    surface.materials.push_back({named.name, table ? *table : tabulatedBrdf(named.model), {}});
    return surface;
}

void checkMaterialArguments(const RenderArguments& arguments)
{
    if (arguments.surface.empty() == arguments.material.empty()) {
        throw Error("", "one thing to render is needed", "either SURFACE or --material SPEC", Error::kUsage);
    }
    if (!arguments.material.empty() && arguments.onto.empty()) {
        throw Error("", "--material has no shape of its own", "--onto NORMALS or --onto NAME.nacre", Error::kUsage);
    }
}

// The surface to draw: the measured one, or its first material on other normals; fitted into --size where given.
Surface surfaceToDraw(const RenderArguments& arguments, Surface measured, const Context& context)
{
    if (!arguments.onto.empty()) {
        if (measured.materials.empty()) {
            throw Error(arguments.surface, "holds no material", "one to put onto other normals");
        }
        const NormalMap normals = std::filesystem::is_directory(arguments.onto)
                                      ? loadSurface(arguments.onto).normals
                                      : loadNormalMap(arguments.onto, normalYOf(arguments));
        measured = transferredSurface(normals, measured.materials.front());
    }
    if (!arguments.size.empty()) {
        const PictureSize size = sizeFromArgument("--size", arguments.size);
        requirePictureSize(context, size.width, size.height); // before memory for it is asked for
        measured = fittedSurface(measured, size.width, size.height);
    }
    return measured;
}

// A table answers with its border's values beyond the directions that it spans: said, not refused.
void noteLightsBeyondTable(const Scene& scene)
{
    for (const Material& material : scene.surface.materials) {
        const TableDomain& domain = material.table.domain;
        const auto beyond = std::count_if(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
            constexpr float kTolerance = 0.001f; // radians
            const float thetaD = halfDifferenceFromDirections(scene.view, light.direction, scene.view).thetaD;
            return domain.coordinates == kHalfDifference && thetaD > domain.thetaDMax + kTolerance;
        });
        if (beyond > 0) {
            fmt::print(stderr,
                       "nacre: note: the table of '{}' spans lights up to {:.0f} degrees from the view; of {} given {} "
                       "lie beyond, there its last values are used\n",
                       material.name, 2 * glm::degrees(domain.thetaDMax), scene.lights.size(), beyond);
        }
    }
}

std::vector<ImageAttribute> attributesOf(const DeviceInfo& device)
{
    return {{"Software", "nacre " NACRE_VERSION}, {"Device", device.name}, {"Driver", device.driver}};
}

void runRender(const RenderArguments& arguments)
{
    const bool forTheEye = isForTheEye(arguments);
    normalYOf(arguments);
    checkMaterialArguments(arguments);
    WholeOutput(arguments.output, arguments.force); // refuses now what it would refuse after the work
    Surface measured = arguments.material.empty() ? loadSurface(arguments.surface) : surfaceOfMaterial(arguments);
    Scene scene;
    scene.lights = lightsFromArguments(arguments.lights, measured.lights);
    const Context context(arguments.device);
    scene.surface = surfaceToDraw(arguments, std::move(measured), context);
    const Frame frame = Renderer(context).render(scene);

    const float stops = arguments.exposure ? *arguments.exposure : automaticExposure(frame);
    if (forTheEye) {
        saveImage(arguments.output, displayImage(frame, stops), PixelType::uint8, attributesOf(context.info()));
    } else {
        saveImage(arguments.output, frame, PixelType::float32, attributesOf(context.info()));
    }
    if (arguments.quiet) {
        return;
    }
    noteLightsBeyondTable(scene);
    fmt::print("rendered     {}x{} pixels under {} light{}\ndevice       {}\n", frame.width, frame.height,
               scene.lights.size(), scene.lights.size() == 1 ? "" : "s", describe(context.info()));
    if (forTheEye) {
        fmt::print("exposure     {:+.2f} stops{}\n", stops, arguments.exposure ? "" : " (automatic)");
    }
    fmt::print("wrote        {}\n", arguments.output.string());
}

} // namespace

void addRenderCommand(CLI::App& app)
{
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "A surface, or its material on other normals, under any lights");
    command->add_option("SURFACE", arguments->surface, "Folder NAME.nacre that acquire wrote; or --material");
    command->add_option(
        "--material", arguments->material,
        "In place of SURFACE, with --onto: FILE.binary (MERL), FILE.bsdf (RGL), FILE.exr (our table) or "
        "a model as synth takes it");
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv "
                        "[environment variable NACRE_FITS_DIR]");
    command
        ->add_option("--light", arguments->lights,
                     "x,y,z[,r,g,b]: direction towards the light (x right, y up, z towards the camera), irradiance "
                     "(default 1); or captured:N. Repeatable (default: captured:1)")
        ->allow_extra_args(false);
    CLI::Option* onto =
        command->add_option("--onto", arguments->onto,
                            "Put the first material onto these camera-frame normals: .exr, .png (16-bit "
                            "best; n = 2v - 1, black = no data) or another NAME.nacre; a tangent-space "
                            "map makes a flat piece seen from the front");
    command->add_option("--normal-y", arguments->normalY, "Green of --onto's picture: gl (up) or dx (down)")
        ->needs(onto)
        ->capture_default_str();
    command->add_option("--size", arguments->size, "WxH pixels to fit the surface into (default: its own size)");
    command->add_option("--exposure", arguments->exposure,
                        "Stops, on PNG only (default: the 99th percentile of radiance at 0.9)");
    command->add_option("--device", arguments->device, "Vulkan device: number or part of its name, see nacre info");
    command->add_option("-o,--output", arguments->output, "Picture to write: .png (8-bit sRGB) or .exr (linear)")
        ->required();
    command->add_flag("--force", arguments->force, "Replace an output that exists");
    command->add_flag("--quiet", arguments->quiet, "Print nothing");
    command->footer("Example:\n  nacre render horse.nacre --light=-0.5,0.3,1 --light 0.6,0,1,1,0.8,0.6 --size 640x480 "
                    "-o horse.png\n  nacre render horse.nacre --onto cloth.exr -o cloth.exr\n"
                    "  nacre render --material paper_white_rgb.bsdf --onto cloth.exr -o paper.png");
    command->callback([arguments] { runRender(*arguments); });
}

} // namespace nacre
