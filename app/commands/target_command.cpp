#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/target_source.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/text_files.h"

namespace nacre {

namespace {

void print(const TargetReport& report)
{
    const Surface& surface = report.surface;
    for (const std::string& line : report.lines) {
        fmt::print("{}\n", line);
    }
    const auto known = std::count_if(surface.normals.confidence.begin(), surface.normals.confidence.end(),
                                     [](float confidence) { return confidence > 0; });
    fmt::print("picture      {}x{}, {} pixels with a normal\n", surface.normals.width, surface.normals.height, known);
    const auto [lowest, highest] = std::minmax_element(surface.height.values.begin(), surface.height.values.end());
    fmt::print("height       {:.1f} to {:.1f} pixels\n", *lowest, *highest);
    for (size_t i = 0; i < surface.parts.size(); ++i) {
        const auto pixels = std::count(surface.labels.begin(), surface.labels.end(), i);
        fmt::print("part {:<7} {}: {} pixels\n", i + 1, surface.parts[i], pixels);
    }
    double sum = 0;
    fmt::print("seconds      ");
    for (const TargetStage& stage : report.stages) {
        fmt::print("{} {:.2f}, ", stage.name, stage.seconds);
        sum += stage.seconds;
    }
    fmt::print("in all {:.2f}\n", sum);
}

void runTarget(const TargetCommandArguments& arguments)
{
    if (lowerExtension(arguments.output) != ".nacre") {
        throw Error(arguments.output, "is no name for a surface", "-o NAME.nacre", Error::kUsage);
    }
    requireWholeFolder(arguments.output, arguments.force, kSurfaceDescription);
    TargetReport report = targetFromSource(arguments);
    for (const std::string& warning : report.warnings) {
        fmt::print(stderr, "nacre: warning: {}\n", warning);
    }
    const Stopwatch watch;
    saveSurface(arguments.output, report.surface, arguments.force);
    report.stages.push_back({"write", watch.seconds()});
    if (!arguments.quiet) {
        print(report);
        fmt::print("wrote        {}\n", arguments.output.string());
    }
}

} // namespace

void addTargetCommand(CLI::App& app)
{
    auto arguments = std::make_shared<TargetCommandArguments>();
    CLI::App* command = app.add_subcommand("target", "A mesh, height map or normal map as a surface for materials");
    command
        ->add_option("SOURCE", arguments->source,
                     "Mesh (.obj, .ply, .gltf, .glb, .stl), height map (one channel), normal map, NAME.nacre, or "
                     "make:NAME, a shape that is generated")
        ->required();
    command->add_option("-o,--output", arguments->output, "Surface to write, NAME.nacre")
        ->option_text("OUT.nacre")
        ->required();
    command->add_option("--from", arguments->from, "Direction x,y,z from a mesh towards the distant viewer [0,0,1]");
    command->add_option("--up", arguments->up,
                        "Direction x,y,z of a mesh that is up in the picture [0,1,0; seen along y: 0,0,-1]");
    command->add_option("--size", arguments->size,
                        "Size in pixels, WxH (default: 1024x1024; of pictures and surfaces their own)");
    command->add_option("--normal-map", arguments->normalMap,
                        "Tangent-space normal map for all parts of a mesh with UVs (default: those of its materials)");
    command->add_option("--normal-y", arguments->normalY, "Green of a normal map: gl (up) or dx (down) [gl]");
    command->add_option(
        "--height-scale", arguments->heightScale,
        "Height from black to white of a height map: pixels, or a share of the width in % (default: 5%; "
        "floats are pixels)");
    command->add_option(
        "--device", arguments->device,
        "Vulkan device: number or part of its name in nacre info (default: $NACRE_DEVICE, else the best)");
    command->add_option("--threads", arguments->threads, "Number of threads for make:NAME (default: all)");
    command->add_flag("--force", arguments->force, "Replacement of an existing output");
    command->add_flag("--quiet", arguments->quiet, "No messages but warnings");
    command->footer("Example:\n  nacre target statue.obj --from 1,0.2,1 -o statue.nacre\n"
                    "  nacre render horse.nacre --onto statue.nacre --light=-1,1,1 -o statue.png\n"
                    "  nacre target cloth_height.png --height-scale 12 -o cloth.nacre\n"
                    "  nacre target make:cloth -o cloth.nacre");
    command->callback([arguments] { runTarget(*arguments); });
}

} // namespace nacre
