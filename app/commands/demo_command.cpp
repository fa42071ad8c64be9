#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/chain/acquire.h"
#include "app/arguments/destinations.h"
#include "app/arguments/model_arguments.h"
#include "app/commands/commands.h"
#include "app/page/page_export.h"
#include "app/report/acquisition_summary.h"
#include "app/report/contact_sheet.h"
#include "app/report/progress_line.h"
#include "assets/cloth/woven_cloth.h"
#include "assets/head/statue_head.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "engine/gpu/renderer.h"

namespace nacre {

namespace {

constexpr const char* kSheet = "demo.png";
constexpr const char* kPage = "demo.html";
constexpr int kPagePhotographs = 4;
constexpr int kPageCloth = 240; // pixels of a side
constexpr const char* kPageBytes = "1500000";
constexpr int kTargetSize = 320;       // pixels of each target's side on the sheet
constexpr size_t kShownPhotograph = 5; // an oblique light, so that shape and shadow show

struct DemoArguments {
    std::filesystem::path folder = "nacre-demo";
    std::string device;
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

struct Lighting {
    const char* name;
    std::vector<Light> lights;
};

Light lightFrom(const glm::vec3& direction, const glm::vec3& irradiance)
{
    return {glm::normalize(direction), irradiance};
}

std::vector<Lighting> lightings()
{
    return {
        {"one light, upper left", {lightFrom({-0.55f, 0.5f, 0.7f}, glm::vec3(1))}},
        {"warm key, cool rim",
         {lightFrom({0.6f, 0.35f, 0.7f}, {1.0f, 0.82f, 0.6f}), lightFrom({-0.8f, 0.1f, 0.45f}, {0.25f, 0.4f, 0.7f})}}};
}

Image display(const Frame& frame)
{
    return displayedImage(frame, {.exposureStops = automaticExposure(frame)});
}

// The absolute difference, in units of the photograph's exposure, four times as bright.
Image amplifiedDifference(const Image& a, const Image& b)
{
    Image difference(a.width, a.height, 3);
    for (size_t i = 0; i < difference.values.size(); ++i) {
        difference.values[i] = 4 * std::abs(a.values[i] - b.values[i]);
    }
    return difference;
}

Image maskedPhotograph(const Capture& capture)
{
    Image photograph = loadPhotograph(capture.photographs[kShownPhotograph].exposures.front().file, capture.curve);
    for (size_t i = 0; i < capture.mask.size(); ++i) {
        if (!capture.mask[i]) {
            std::fill_n(&photograph.values[i * photograph.channels], photograph.channels, 0.0f);
        }
    }
    return photograph;
}

// The photograph, the same re-rendered, and what is between them.
std::vector<SheetCell> comparisonRow(const Capture& capture, const Surface& surface, Renderer& renderer)
{
    const Image photograph = maskedPhotograph(capture);
    renderer.setSurface(surface);
    const Frame frame = renderer.render(std::vector<Light>{surface.lights[kShownPhotograph].light});
    const float exposure = automaticExposure(photograph);
    const Image shown = displayedImage(photograph, {.exposureStops = exposure}),
                rendered = displayedImage(frame, {.exposureStops = exposure});
    const double psnr = radiancePsnr(frame, photograph, capture.mask, peakOf(photograph, capture.mask));
    Image normals(surface.normals.width, surface.normals.height, 3);
    for (size_t i = 0; i < surface.normals.normals.size(); ++i) {
        if (surface.normals.confidence[i] > 0) {
            normals.setRgb(static_cast<int>(i % normals.width), static_cast<int>(i / normals.width),
                           0.5f + 0.5f * surface.normals.normals[i]);
        }
    }
    return {{shown, fmt::format("photograph {}", kShownPhotograph + 1)},
            {normals, "normals"},
            {rendered, fmt::format("re-rendered, {:.1f} dB", psnr)},
            {amplifiedDifference(shown, rendered), "difference x 4"}};
}

NormalMap demoCloth(int side)
{
    return wovenCloth(side, side, {.weave = "twill", .threads = 18}).normals;
}

std::vector<PageShape> demoShapes()
{
    std::vector<PageShape> shapes(2);
    shapes[0].name = "woven cloth";
    shapes[0].surface.normals = demoCloth(kTargetSize);
    shapes[1].name = "carved head";
    shapes[1].surface.normals = statueHead(kTargetSize, kTargetSize).normals;
    return shapes;
}

std::vector<SheetCell> transferRow(const PageShape& shape, const Material& material, Renderer& renderer)
{
    std::vector<SheetCell> row;
    renderer.setSurface(transferredSurface(shape.surface.normals, material));
    for (const Lighting& lighting : lightings()) {
        row.push_back({display(renderer.render(lighting.lights)), fmt::format("{}: {}", shape.name, lighting.name)});
    }
    return row;
}

void append(std::vector<SheetCell>& row, std::vector<SheetCell> more)
{
    std::move(more.begin(), more.end(), std::back_inserter(row));
}

// The embedded capture is generated: its bytes follow from its seed.
Capture demoPhotographs(const DemoArguments& arguments, const std::filesystem::path& folder)
{
    SynthOptions options = demoCapture();
    options.threads = arguments.threads;
    writeSynthCapture(folder / "capture", makeSynthScene(options), false);
    return loadCapture(folder / "capture");
}

Image makeSheet(const Capture& capture, const Surface& surface, const std::vector<PageShape>& shapes,
                const DemoArguments& arguments)
{
    const Context context(arguments.device);
    Renderer renderer(context);
    std::vector<std::vector<SheetCell>> rows;
    rows.push_back(comparisonRow(capture, surface, renderer));
    rows.emplace_back();
    for (const PageShape& shape : shapes) {
        append(rows.back(), transferRow(shape, surface.materials.front(), renderer));
    }
    return contactSheet(rows, kTargetSize, kTargetSize);
}

// The same to be lit in a browser.
SurfacePage makeDemoPage(const DemoArguments& arguments, const std::filesystem::path& folder, const Surface& surface,
                         std::vector<PageShape> shapes)
{
    PageArguments page;
    page.capture = folder / "capture";
    page.photographs = kPagePhotographs;
    page.size.budget = kPageBytes;
    page.threads = arguments.threads;
    shapes.front().surface.normals = demoCloth(kPageCloth); // its yarns are most of what the page would hold
    return pageOfSurface(page, folder / "demo.nacre", surface, std::move(shapes));
}

void runDemo(const DemoArguments& arguments)
{
    const Stopwatch watch;
    if (arguments.threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all",
                    Error::kUsage);
    }
    requireWholeFolder(arguments.folder, arguments.force, kSheet);
    WholeOutput output(arguments.folder, arguments.force);
    std::filesystem::create_directory(output.temporary());
    if (!arguments.quiet) {
        fmt::print("Making the demo's photographs (36 lights, a mirror and a diffuse sphere) ...\n");
    }
    const Capture capture = demoPhotographs(arguments, output.temporary());
    AcquireOptions options;
    options.setThreads(arguments.threads);
    options.residual = ResidualArguments{}.options(options.ladder);
    options.castShadows = ResidualArguments{}.castShadows();
    const Acquisition result = acquire(capture, options, progressLine(arguments.quiet));
    endProgressLine(arguments.quiet);
    saveSurface(output.temporary() / "demo.nacre", result.surface, false);
    const std::vector<PageShape> shapes = demoShapes();
    const Image sheet = makeSheet(capture, result.surface, shapes, arguments);
    saveImage(output.temporary() / kSheet, sheet, PixelType::uint8);
    const SurfacePage page = makeDemoPage(arguments, output.temporary(), result.surface, shapes);
    writeTextFile(output.temporary() / kPage, page.text.html);
    output.commit();
    if (!arguments.quiet) {
        fmt::print("{}{}{}", describeNormals(capture, result.estimate), describeBrdf(result),
                   describe(result.estimate.times));
        fmt::print("page         {:.2f} MB\n", static_cast<double>(page.text.html.size()) / 1e6);
        for (const std::string& line : page.lines) {
            fmt::print("  {}\n", line);
        }
        fmt::print("in all       {:.1f} seconds\n", watch.seconds());
    }
    for (const char* file : {kSheet, kPage}) {
        fmt::print("{}\n", (std::filesystem::absolute(arguments.folder) / file).string());
    }
}

} // namespace

void addDemoCommand(CLI::App& app)
{
    auto arguments = std::make_shared<DemoArguments>();
    CLI::App* command = app.add_subcommand("demo", "The whole chain on a small capture that is made on the spot");
    command->add_option("-o,--output", arguments->folder, "Folder for the capture, the surface, demo.png and demo.html")
        ->option_text("OUT")
        ->capture_default_str();
    command->add_option(
        "--device", arguments->device,
        "Vulkan device: number or part of its name in nacre info (default: $NACRE_DEVICE, else the best)");
    command->add_option("--threads", arguments->threads, "Number of threads (default: all)");
    command->add_flag("--force", arguments->force, "Replacement of an existing folder");
    command->add_flag("--quiet", arguments->quiet, "No messages but the paths of picture and page");
    command->footer("Example:\n  nacre demo -o /tmp/nacre-demo");
    command->callback([arguments] { runDemo(*arguments); });
}

} // namespace nacre
