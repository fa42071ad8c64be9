#include "app/arguments/chart_arguments.h"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/files/error.h"
#include "engine/scene/picture_size.h"

namespace nacre {

namespace {

size_t numberFrom(const char* option, const std::string& text, size_t least, size_t most)
{
    const bool digits = !text.empty() && text.size() < 7 && text.find_first_not_of("0123456789") == std::string::npos;
    const size_t value = digits ? std::stoul(text) : 0;
    if (value < least || value > most) {
        throw Error("", fmt::format("{} {} is not understood", option, text), fmt::format("{} to {}", least, most),
                    Error::kUsage);
    }
    return value;
}

void setFrames(const ChartArguments& arguments, RenderingChoices& frames)
{
    constexpr size_t kMostLights = 100000;
    const PictureSize size = sizeFromArgument("--frame-size", arguments.frameSize);
    frames.width = size.width;
    frames.height = size.height;
    if (!arguments.frameLights.empty()) {
        frames.lights.clear();
    }
    for (const std::string& count : arguments.frameLights) {
        frames.lights.push_back(numberFrom("--frame-lights", count, 1, kMostLights));
    }
}

} // namespace

ChartChoices ChartArguments::choices() const
{
    ChartChoices chosen;
    const std::map<std::string, bool*> wanted{
        {"normals", &chosen.normals}, {"brdf", &chosen.brdf}, {"rendering", &chosen.rendering}};
    for (const auto& [name, part] : wanted) {
        *part = false;
    }
    for (const std::string& part : parts) {
        if (!wanted.contains(part)) {
            throw Error("", "--parts " + part + " is not known", "normals, brdf, rendering", Error::kUsage);
        }
        *wanted.at(part) = true;
    }
    if (!methods.empty()) {
        chosen.methods.clear();
    }
    for (const std::string& name : methods) {
        chosen.methods.push_back(normalMethodFromName(name));
    }
    if (!lights.empty()) {
        chosen.lightsGiven.clear();
    }
    for (const std::string& count : lights) {
        chosen.lightsGiven.push_back(
            count == "all" || count == "0" ? 0 : numberFrom("--lights-given", count, kFewestLightsGiven, 100000));
    }
    if (!neighbours.empty()) {
        chosen.neighbours.clear();
    }
    for (const std::string& k : neighbours) {
        chosen.neighbours.push_back(static_cast<int>(numberFrom("--k", k, 1, kMostNeighbours)));
    }
    setFrames(*this, chosen.frames);
    return chosen;
}

void ChartArguments::addTo(CLI::App& command)
{
    command.add_option("CAPTURE", captures, "Folders of photographs")->required();
    command
        .add_option(
            "-o,--output", output,
            "Folder to write: report.html, normals.csv, brdf.csv, rendering.csv, charts as .svg (by gnuplot, where "
            "installed) and the scripts .gp that draw them")
        ->required();
    command.add_option("--mirror-sphere", capture.mirrorSphere,
                       "Folder of a mirror sphere's photographs, for all captures");
    command.add_option("--diffuse-sphere", capture.diffuseSphere,
                       "Folder of a diffuse sphere's photographs, for all captures");
    command.add_option("--rig", capture.rig, "Lights from a file, for all captures");
    command.add_option("--parts", parts, "normals, brdf, rendering (default: all)")->delimiter(',');
    command.add_option("--methods", methods, "NAME[,NAME] of " + normalMethodNames() + " (default: all)")
        ->delimiter(',');
    command
        .add_option("--lights-given", lights,
                    fmt::format("COUNT[,COUNT] of photographs given, 0 for all (default: {})",
                                fmt::join(ChartChoices{}.lightsGiven, ",")))
        ->delimiter(',');
    command
        .add_option("--k", neighbours,
                    fmt::format("Neighbours tried, N[,N] (default: {})", fmt::join(ChartChoices{}.neighbours, ",")))
        ->delimiter(',');
    command
        .add_option("--frame-lights", frameLights,
                    fmt::format("Lights of the frames, N[,N] (default: {})", fmt::join(RenderingChoices{}.lights, ",")))
        ->delimiter(',');
    command.add_option("--frame-size", frameSize, "Of the frames, WxH")->capture_default_str();
    command.add_option("--fits", fits,
                       "Folder of published fits that exemplars use [environment variable NACRE_FITS_DIR]");
    command.add_option("--device", device, "Vulkan device that draws: number or part of its name, see nacre info");
    command.add_option("--threads", threads, "Threads (default: all)")->check(CLI::NonNegativeNumber);
    command.add_flag("--quiet", quiet, "No progress, no summary");
    command.add_flag("--force", force, "Replace an output that exists");
}

} // namespace nacre
