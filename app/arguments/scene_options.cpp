#include "app/arguments/scene_options.h"

namespace nacre {

namespace {

std::vector<LightSource> lightSourcesFrom(const std::vector<std::string>& texts)
{
    std::vector<LightSource> sources;
    for (const std::string& text : texts) {
        sources.push_back(lightSourceFromText(text));
    }
    return sources;
}

} // namespace

void SceneOptions::addTo(CLI::App& command, const Help& help)
{
    using Description = SceneDescription;
    add<std::string>(command, "SURFACE", &Description::surface, "Folder NAME.nacre of nacre acquire; or --material");
    add<std::string>(command, "--material", &Description::material, help.material);
    command
        .add_option("--fits", fits, "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)")
        ->group("Materials and shapes");
    command
        .add_option_function<std::vector<std::string>>(
            "--light",
            [this](const std::vector<std::string>& texts) {
                given_.push_back([texts](Description& scene) { scene.lights = lightSourcesFrom(texts); });
            },
            help.light)
        ->allow_extra_args(false);
    add<std::string>(command, "--onto", &Description::onto, help.onto);
    addParsed(command, "--turn", &Description::turn, turnFromText,
              "Turn of the mesh, or of the surface by its height, in degrees, YAW,PITCH[,ROLL]: front to the right, "
              "top nearer, counter-clockwise "
              "(default: 0,0)")
        ->group("Materials and shapes");
    addParsed(command, "--normal-y", &Description::normalY, normalYFromName,
              "Green of the normals of --onto: gl (up) or dx (down) [gl]")
        ->group("Materials and shapes");
    addParsed(
        command, "--size", &Description::size, [](const std::string& text) { return sizeFromArgument("--size", text); },
        "Size in pixels that the surface is fitted into, WxH (default: its own)");
    add<float>(command, "--exposure", &Description::exposure, help.exposure);
    add<std::string>(command, "--environment", &Description::environment, help.environment);
    addParsed(command, "--show", &Description::show, showFromName, help.show);
    addParsed(command, "--layer", &Description::residual, residualUseFromName, help.layer);
    command.add_option("--state", state_, help.state);
    command
        .add_option("--device", device,
                    "Vulkan device: number or part of its name in nacre info (default: $NACRE_DEVICE, else the best)")
        ->group("Running");
}

CLI::Option* SceneOptions::addFlag(CLI::App& command, const std::string& name,
                                   std::optional<bool> SceneDescription::*field, const std::string& help)
{
    return command.add_flag_function(
        name,
        [this, field](int64_t count) {
            given_.push_back([field, count](SceneDescription& scene) { scene.*field = count > 0; });
        },
        help);
}

SceneDescription SceneOptions::description() const
{
    SceneDescription scene = state_.empty() ? SceneDescription{} : sceneFromFile(state_);
    for (const auto& set : given_) {
        set(scene);
    }
    return scene;
}

} // namespace nacre
