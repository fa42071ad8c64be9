#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/arguments/scene_options.h"
#include "app/commands/commands.h"
#include "app/materials/captured_photographs.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/picture_size.h"
#include "engine/viewer/viewer.h"
#include "engine/viewer/window.h"

namespace nacre {

namespace {

struct ViewArguments {
    SceneOptions scene;
    std::filesystem::path capture;
    std::filesystem::path screenshots;
    std::filesystem::path output;
    std::string window;
    bool headless = false;
    bool force = false;
};

void check(const ViewArguments& arguments, const SceneDescription& scene)
{
    if (arguments.headless && lowerExtension(arguments.output) != ".png") {
        throw Error("", "--headless has nowhere to draw to", "-o FILE.png with it", Error::kUsage);
    }
    if (!arguments.headless && !arguments.output.empty()) {
        throw Error("", "-o is for --headless", "F12 in the window, or --headless -o FILE.png", Error::kUsage);
    }
    if (!arguments.capture.empty() && scene.surface.empty()) {
        throw Error("", "--capture has no surface that was measured from it", "SURFACE with it", Error::kUsage);
    }
    if (arguments.headless && (!arguments.window.empty() || !arguments.screenshots.empty())) {
        throw Error("", "--window and --screenshots are the window's", "--size and -o with --headless", Error::kUsage);
    }
    if (arguments.capture.empty() && scene.show == Show::verdicts) {
        throw Error("", "verdicts need the photographs", "--capture FOLDER, from which SURFACE was measured",
                    Error::kUsage);
    }
    if (!arguments.screenshots.empty() && !std::filesystem::is_directory(arguments.screenshots)) {
        throw Error(arguments.screenshots, "is no folder", "one for screenshots");
    }
    requireConsistent(scene);
}

std::vector<const char*> windowExtensions()
{
    try {
        return Window::vulkanExtensions();
    } catch (const Error& e) {
        throw Error("", e.what(), "or --headless -o FILE.png");
    }
}

// A window shows one picture.
SceneDescription sceneFrom(const ViewArguments& arguments)
{
    SceneDescription scene = arguments.scene.description();
    scene.frames = 1;
    scene.motion.reset();
    return scene;
}

void runView(const ViewArguments& arguments)
{
    SceneDescription scene = sceneFrom(arguments);
    check(arguments, scene);
    if (arguments.headless) {
        requireFile(arguments.output, arguments.force);
        requireFile(std::filesystem::path(arguments.output).replace_extension(".json"), arguments.force);
    }
    const PictureSize size = sizeFromArgument("--window", arguments.window.empty() ? "1280x720" : arguments.window);
    makeAbsolute(scene);
    const Choices choices = choicesOf(scene);
    const Context context(arguments.scene.device, arguments.headless ? std::vector<const char*>{} : windowExtensions());
    SceneSource source{.context = context, .fits = arguments.scene.fits, .photographs = nullptr};
    if (!arguments.capture.empty()) {
        source.photographs = photographsOf(arguments.capture, scene.surface);
    }
    if (arguments.headless) {
        viewHeadless(context, scene, choices, source, arguments.output);
        fmt::print("wrote        {}, the render alone, and its state beside it\n", arguments.output.string());
    } else {
        runViewer(context, scene, choices, source,
                  {.width = size.width,
                   .height = size.height,
                   .screenshots = arguments.screenshots.empty() ? "." : arguments.screenshots});
    }
}

} // namespace

void addViewCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ViewArguments>();
    CLI::App* command = app.add_subcommand("view", "A surface in a window: drag the light, swap the material");
    arguments->scene.addTo(
        *command,
        {.material = "Material instead of SURFACE, for --onto, as in nacre render",
         .onto = "Shape for the material, as in nacre render",
         .light = "Light, as in nacre render. Repeatable",
         .environment = "Light from all around, as in nacre render",
         .exposure = "Exposure in stops (default: automatic)",
         .show = "Content: picture, normals, labels, coverage, theta-h, theta-d or, with --capture, verdicts [picture]",
         .layer = "Residual layer: on, off or alone [on]",
         .state = "State file of a screenshot or of nacre render"});
    command->add_option("--capture", arguments->capture, "Folder of the photographs that SURFACE was measured from");
    command->add_option("--screenshots", arguments->screenshots, "Folder for screenshots [.]");
    command->add_option("--window", arguments->window, "Size of the window in pixels, WxH [1280x720]")
        ->group("Running");
    command->add_flag("--headless", arguments->headless, "Picture of --output instead of a window");
    command
        ->add_option("-o,--output", arguments->output, "Picture for --headless, .png; its state is written beside it")
        ->option_text("OUT.png");
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->footer("Example:\n  nacre view horse.nacre --capture horse\n  nacre view horse.nacre --onto cloth.exr\n"
                    "  nacre view --state nacre-0001.json --headless -o again.png\nIn the window, H shows the keys.");
    command->callback([arguments] { runView(*arguments); });
}

} // namespace nacre
