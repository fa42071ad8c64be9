#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/error.h"
#include "engine/materials/material_specification.h"

namespace nacre {
namespace {

struct SynthArguments {
    SynthOptions options;
    std::filesystem::path output;
    std::filesystem::path fits;
    std::vector<std::string> materials;
    std::string shape = "bumpy";
    std::string format = "png";
    int size = SynthOptions{}.width;
    bool noShadows = false;
    bool force = false;
    bool quiet = false;
};

constexpr const char* kExample =
    "Example:\n"
    "  nacre synth bronze --material 'ggx:diffuse=0.05,0.03,0.02;specular=0.6,0.4,0.25;alpha=0.25' --lights 48\n"
    "  nacre synth dog --material 'ggx:diffuse=0.7,0.7,0.7;alpha=0.3' --material "
    "'ggx:diffuse=0.03,0.03,0.03;alpha=0.1'\n"
    "  nacre synth plastic --material merl-sgd:red-plastic --fits FOLDER --exposures 1,0.25,0.0625\n"
    "Materials: lambert:R,G,B  ggx:diffuse=R,G,B;specular=R,G,B;alpha=A  merl-abc:NAME  merl-sgd:NAME\n"
    "  FILE.binary (MERL)  FILE.bsdf (RGL, isotropic RGB)  FILE.exr (Nacre's table)";

void describe(const SynthArguments& arguments, const SynthScene& scene)
{
    const SynthOptions& o = scene.options;
    fmt::print("{}: {} photographs{} of {}x{}, {} pixels of the object, mirror and diffuse sphere {}x{}\n",
               arguments.output.string(), o.lights,
               o.exposures.size() > 1 ? fmt::format(" in {} exposures", o.exposures.size()) : "", o.width, o.height,
               scene.view.seen.size(), o.sphereSize, o.sphereSize);
    fmt::print(
        "material {}; value = {:.6g} x radiance; noise {:.3g} of full scale; diffuse sphere's reflectance {:g}\n",
        o.patches.empty() ? o.material : fmt::format("{}, {} in patches", o.material, fmt::join(o.patches, ", ")),
        scene.sensor.gain, scene.sensor.noise, o.sphereReflectance.x);
    fmt::print("truth in {}; seed {}\n", (arguments.output / "truth").string(), o.seed);
}

SynthShape shapeOf(const std::string& name)
{
    if (name == "bumpy") {
        return SynthShape::bumpy;
    }
    if (name != "sphere" && name != "bowl") {
        throw Error("", fmt::format("--shape {} is not known", name), "bumpy, bowl or sphere", Error::kUsage);
    }
    return name == "bowl" ? SynthShape::bowl : SynthShape::sphere;
}

SynthFormat formatOf(const std::string& name)
{
    if (name != "png" && name != "exr") {
        throw Error("", fmt::format("--format {} is not known", name), "png or exr", Error::kUsage);
    }
    return name == "png" ? SynthFormat::png16 : SynthFormat::exr;
}

void run(SynthArguments& arguments)
{
    SynthOptions& o = arguments.options;
    o.shape = shapeOf(arguments.shape);
    o.format = formatOf(arguments.format);
    if (o.threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", o.threads), "1 or more, or 0 for all",
                    Error::kUsage);
    }
    requireWholeFolder(arguments.output, arguments.force, "capture.json");
    o.width = o.height = arguments.size;
    o.shadows = !arguments.noShadows;
    if (!arguments.materials.empty()) {
        o.material = arguments.materials.front();
        o.patches.assign(arguments.materials.begin() + 1, arguments.materials.end());
    }
    o.fitsFolder = fitsFolderFrom(arguments.fits);
    const SynthScene scene = makeSynthScene(o);
    writeSynthCapture(arguments.output, scene, arguments.force);
    if (!arguments.quiet) {
        describe(arguments, scene);
    }
}

} // namespace

void addSynthCommand(CLI::App& app)
{
    auto arguments = std::make_shared<SynthArguments>();
    SynthOptions& o = arguments->options;
    CLI::App* command = app.add_subcommand("synth", "Make a capture of a solid whose truth is known");
    command->footer(kExample);
    command->add_option("OUT", arguments->output, "Folder to write")->option_text("OUT")->required();
    command->add_option("--shape", arguments->shape, "Solid: bumpy (casts shadows), bowl or sphere")
        ->capture_default_str();
    command->add_option("--side", arguments->size, "Side of a photograph in pixels")->capture_default_str();
    command->add_option("--lights", o.lights, "Number of lights, one a photograph")->capture_default_str();
    command
        ->add_option("--material", arguments->materials,
                     "Reflectance, see below; given several times, the object wears them in patches [" + o.material +
                         "]")
        ->option_text("SPEC")
        ->allow_extra_args(false);
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)");
    command
        ->add_option("--noise", o.noise, "Standard deviation of the noise, as a share of the object's 99th percentile")
        ->capture_default_str();
    command->add_option("--format", arguments->format, "Format of the photographs: png (16-bit linear) or exr (float)")
        ->capture_default_str();
    command->add_option("--exposures", o.exposures, "Relative times of each photograph's bracket, e.g. 1,0.25 [1]")
        ->delimiter(',');
    command->add_flag("--no-shadows", arguments->noShadows, "No cast shadows");
    command
        ->add_option("--bounces", o.bounces,
                     "How often light goes from one part of the object to another, as between matt surfaces")
        ->capture_default_str();
    command->add_flag("--shadow-masks", o.shadowMasks, "Pictures truth/shadow_NN.png, white where the light arrives");
    command->add_flag("--give-lights", o.giveLights, "True lights in capture.json");
    command->add_option("--sphere-size", o.sphereSize, "Side of the spheres' photographs in pixels")
        ->capture_default_str();
    command->add_option("--cap-degrees", o.capDegrees, "Largest angle between a light and the view in degrees")
        ->capture_default_str();
    command
        ->add_option("--light-distance", o.lightDistance,
                     "Distance of the lights from the object's middle in widths of the object (0: distant)")
        ->capture_default_str();
    command->add_option("--field-of-view", o.fieldOfView, "Degrees that the width covers (0: the camera is distant)")
        ->capture_default_str();
    command->add_option("--seed", o.seed, "Seed of lights and noise")->capture_default_str();
    command->add_option("--threads", o.threads, "Number of threads (0: all)")->capture_default_str();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->callback([arguments] { run(*arguments); });
}

} // namespace nacre
