#include <array>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/arguments/scene_options.h"
#include "app/commands/commands.h"
#include "app/materials/captured_photographs.h"
#include "app/materials/target_source.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/picture_size.h"
#include "engine/view_state/recent_files.h"
#include "engine/viewer/headless_view.h"
#include "engine/viewer/viewer.h"
#include "engine/viewer/window.h"

namespace nacre {

namespace {

// Offered in every window; where nothing is named, the last of them under the first material.
constexpr std::array kShapes = {"make:sphere", "make:cloth:twill", "make:knit", "make:letters", "make:head"};
constexpr std::array kMaterials = {"ggx:diffuse=0.5,0.2,0.1;specular=0.05;alpha=0.15",
                                   "ggx:diffuse=0,0,0;specular=0.9,0.6,0.25;alpha=0.25", "lambert:0.6,0.6,0.55"};
constexpr const char* kDemoSurface = "nacre-demo/demo.nacre"; // of nacre demo
constexpr const char* kDemoCapture = "nacre-demo/capture";

struct ViewArguments {
    SceneOptions scene;
    std::filesystem::path capture;
    std::filesystem::path screenshots;
    std::filesystem::path output;
    std::string window;
    float textScale = 1;
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

// What is not said: the demo's surface where it lies here, or a material on a head.
void complete(SceneDescription& scene, std::filesystem::path& capture)
{
    if (scene.surface.empty() && scene.material.empty() && scene.onto.empty() &&
        std::filesystem::is_directory(kDemoSurface)) {
        scene.surface = kDemoSurface;
        capture = capture.empty() && std::filesystem::is_directory(kDemoCapture) ? kDemoCapture : capture;
    } else if (scene.surface.empty() && scene.material.empty()) {
        scene.material = kMaterials.front();
        scene.materials.insert(scene.materials.end(), kMaterials.begin() + 1, kMaterials.end());
    }
    if (!scene.material.empty() && scene.onto.empty()) {
        scene.onto = kShapes.back();
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

void runView(ViewArguments arguments)
{
    SceneDescription scene = sceneFrom(arguments);
    complete(scene, arguments.capture);
    check(arguments, scene);
    if (arguments.headless) {
        requireFile(arguments.output, arguments.force);
        requireFile(std::filesystem::path(arguments.output).replace_extension(".json"), arguments.force);
    }
    const PictureSize size = sizeFromArgument("--window", arguments.window.empty() ? "1280x720" : arguments.window);
    makeAbsolute(scene);
    const std::vector<std::filesystem::path> shapes(kShapes.begin(), kShapes.end());
    Choices choices = choicesOf(scene);
    addTargets(choices, shapes);
    const Context context(arguments.scene.device, arguments.headless ? std::vector<const char*>{} : windowExtensions());
    SceneSource source{
        .context = context, .inputs = sceneInputs(arguments.scene.fits), .shapes = shapes, .photographs = nullptr};
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
                   .screenshots = arguments.screenshots.empty() ? "." : arguments.screenshots,
                   .textScale = arguments.textScale,
                   .recent = recentFilesList()});
    }
}

} // namespace

void addViewCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ViewArguments>();
    CLI::App* command = app.add_subcommand("view", "A surface in a window: drag the light, swap the material and the "
                                                   "shape. Without arguments the demo's surface, or "
                                                   "a material on a head");
    arguments->scene.addTo(
        *command,
        {.material = "Material instead of SURFACE, as in nacre render",
         .onto = "Shape for the material, as in nacre render (default: make:head)",
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
    command->add_option("--ui-scale", arguments->textScale, "Scale of the window's text and controls [1]")
        ->check(CLI::Range(0.5, 4.0))
        ->group("Running");
    command->add_flag("--headless", arguments->headless, "Picture of --output instead of a window");
    command
        ->add_option("-o,--output", arguments->output, "Picture for --headless, .png; its state is written beside it")
        ->option_text("OUT.png");
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->footer(
        "Example:\n  nacre view\n  nacre view horse.nacre --capture horse\n  nacre view horse.nacre --onto cloth.exr\n"
        "  nacre view --state nacre-0001.json --headless -o again.png\nIn the window, H shows the keys.");
    command->callback([arguments] { runView(*arguments); });
}

} // namespace nacre
