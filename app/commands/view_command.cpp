#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/captured_photographs.h"
#include "app/materials/view_choices.h"
#include "engine/files/error.h"
#include "engine/loading/material_argument.h"
#include "engine/loading/render_scene.h"
#include "engine/loading/size_argument.h"
#include "engine/viewer/viewer.h"
#include "engine/viewer/window.h"

namespace nacre {

namespace {

struct ViewArguments {
    RenderArguments scene;
    std::filesystem::path capture;
    std::filesystem::path screenshots;
    std::string window;
    bool headless = false;
};

void check(const ViewArguments& arguments)
{
    if (arguments.headless && arguments.scene.output.extension() != ".png") {
        throw Error("", "--headless has nowhere to draw to", "-o FILE.png with it", Error::kUsage);
    }
    if (!arguments.headless && !arguments.scene.output.empty()) {
        throw Error("", "-o is for --headless", "F12 in the window, or --headless -o FILE.png", Error::kUsage);
    }
    if (!arguments.capture.empty() && arguments.scene.surface.empty()) {
        throw Error("", "--capture has no surface that was measured from it", "SURFACE with it", Error::kUsage);
    }
    if (arguments.headless && (!arguments.window.empty() || !arguments.screenshots.empty())) {
        throw Error("", "--window and --screenshots are the window's", "--size and -o with --headless", Error::kUsage);
    }
    if (!arguments.screenshots.empty() && !std::filesystem::is_directory(arguments.screenshots)) {
        throw Error(arguments.screenshots, "is no folder", "one for screenshots");
    }
    checkSceneArguments(arguments.scene);
}

SceneSource sourceFrom(const ViewArguments& arguments, const Context& context)
{
    const std::filesystem::path fits = arguments.scene.fits;
    const auto renderArguments = [fits](const SceneFile& scene) {
        RenderArguments render;
        static_cast<SceneFile&>(render) = scene;
        render.fits = fits;
        return render;
    };
    SceneSource source{
        .surface = [=, &context](const SceneFile& s) { return surfaceFromArguments(renderArguments(s), context); },
        .material = [=](const std::string& text) { return materialFromArgument(text, fits); },
        .view = [=](const SceneFile& scene) { return viewFromArguments(renderArguments(scene)); },
        .choices = [](const std::filesystem::path& surface) { return choicesOfSurface(surface); },
        .photographs = {}};
    if (!arguments.capture.empty()) {
        source.photographs = photographsOf(arguments.capture, arguments.scene.surface);
    }
    return source;
}

void runView(ViewArguments arguments)
{
    completeFromState(arguments.scene);
    check(arguments);
    if (arguments.headless) {
        requireDestination(arguments.scene.output, arguments.scene.force);
    }
    const PictureSize size = sizeFromArgument("--window", arguments.window.empty() ? "1280x720" : arguments.window);
    makeAbsolute(arguments.scene);
    const ViewState state = viewStateOf(arguments.scene);
    const Choices choices = choicesOf(state);
    const std::vector<const char*> extensions =
        arguments.headless ? std::vector<const char*>{} : Window::vulkanExtensions();
    const Context context(arguments.scene.device, extensions);
    const SceneSource source = sourceFrom(arguments, context);
    if (arguments.headless) {
        viewHeadless(context, state, choices, source, arguments.scene.output);
        fmt::print("wrote        {}, the render alone, and its state beside it\n", arguments.scene.output.string());
    } else {
        runViewer(context, state, choices, source,
                  {.width = size.width,
                   .height = size.height,
                   .screenshots = arguments.screenshots.empty() ? "." : arguments.screenshots});
    }
}

} // namespace

void addViewCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ViewArguments>();
    RenderArguments& scene = arguments->scene;
    CLI::App* command = app.add_subcommand("view", "A surface in a window: drag the light, swap the material");
    command->add_option("SURFACE", scene.surface, "Folder NAME.nacre of nacre acquire; or --material");
    command->add_option("--material", scene.material, "Material instead of SURFACE, for --onto, as in nacre render");
    command
        ->add_option("--fits", scene.fits,
                     "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)")
        ->group("Running");
    command->add_option("--onto", scene.onto, "Shape for the material, as in nacre render");
    command->add_option("--normal-y", scene.normalY, "Green of the normals of --onto: gl (up) or dx (down) [gl]")
        ->group("At the start");
    command->add_option("--size", scene.size, "Size in pixels that the surface is fitted into, WxH (default: its own)")
        ->group("At the start");
    command->add_option("--light", scene.lights, "Light, as in nacre render. Repeatable")
        ->allow_extra_args(false)
        ->group("At the start");
    command->add_option("--environment", scene.environment, "Light from all around, as in nacre render")
        ->group("At the start");
    command->add_option("--exposure", scene.exposure, "Exposure in stops (default: automatic)")->group("At the start");
    command
        ->add_option(
            "--show", scene.show,
            "Content: picture, normals, labels, coverage, theta-h, theta-d or, with --capture, verdicts [picture]")
        ->group("At the start");
    command->add_option("--layer", scene.residual, "Residual layer: on, off or alone [on]")->group("At the start");
    command->add_option("--state", scene.state, "State file of a screenshot or of nacre render");
    command->add_option("--capture", arguments->capture, "Folder of the photographs that SURFACE was measured from");
    command->add_option("--screenshots", arguments->screenshots, "Folder for screenshots [.]");
    command->add_option("--window", arguments->window, "Size of the window in pixels, WxH [1280x720]")
        ->group("Running");
    command
        ->add_option("--device", scene.device,
                     "Vulkan device: number or part of its name in nacre info (default: the first)")
        ->group("Running");
    command->add_flag("--headless", arguments->headless, "Picture of --output instead of a window");
    command->add_option("-o,--output", scene.output, "Picture for --headless, .png; its state is written beside it");
    command->add_flag("--force", scene.force, "Replacement of existing outputs");
    command->footer("Example:\n  nacre view horse.nacre --capture horse\n  nacre view horse.nacre --onto cloth.exr\n"
                    "  nacre view --state nacre-0001.json --headless -o again.png\nIn the window, H shows the keys.");
    command->callback([arguments] { runView(*arguments); });
}

} // namespace nacre
