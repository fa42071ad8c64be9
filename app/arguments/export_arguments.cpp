#include "app/arguments/export_arguments.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "engine/files/error.h"
#include "engine/scene/picture_size.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kFewestLights = 18; // twice the terms of the larger basis
constexpr int kMostLights = 4096;

Error usageError(const std::string& wrong, const std::string& expected)
{
    return Error("", wrong, expected, Error::kUsage);
}

void requireExtension(const char* option, const fs::path& file, const std::vector<std::string>& extensions)
{
    if (!file.empty() && std::find(extensions.begin(), extensions.end(), file.extension()) == extensions.end()) {
        throw usageError(fmt::format("{} {} is no such file", option, file.string()),
                         fmt::format("NAME{}", fmt::join(extensions, " or NAME")));
    }
}

void requireChoices(const ExportArguments& arguments)
{
    requireExtension("--ptm", arguments.ptm, {".ptm"});
    requireExtension("--write-normals", arguments.normals, {".png", ".exr"});
    requireExtension("--albedo", arguments.albedo, {".png", ".exr"});
    if (arguments.ptmFormat != "lrgb" && arguments.ptmFormat != "rgb") {
        throw usageError(fmt::format("--ptm-format {} is not known", arguments.ptmFormat), "lrgb or rgb");
    }
    if (arguments.basis != "hsh" && arguments.basis != "ptm") {
        throw usageError(fmt::format("--basis {} is not known", arguments.basis), "hsh or ptm");
    }
    if (arguments.lights < kFewestLights || arguments.lights > kMostLights) {
        throw usageError(fmt::format("--lights {} is out of range", arguments.lights),
                         fmt::format("{} to {}", kFewestLights, kMostLights));
    }
    if (arguments.exposure && !std::isfinite(*arguments.exposure)) {
        throw usageError("--exposure is not finite", "a number of stops");
    }
    if (!arguments.size.empty()) {
        sizeFromArgument("--size", arguments.size);
    }
    if (arguments.threads < 0) {
        throw usageError(fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all");
    }
}

void requireOutputs(const ExportArguments& arguments)
{
    std::vector<fs::path> outputs = {arguments.ptm, arguments.web, arguments.normals, arguments.albedo};
    std::erase_if(outputs, [](const fs::path& output) { return output.empty(); });
    if (outputs.empty()) {
        throw usageError("nothing is asked for", "--ptm, --rti-web, --write-normals or --albedo");
    }
    for (size_t i = 0; i < outputs.size(); ++i) {
        if (std::find(outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(i), outputs[i]) !=
            outputs.begin() + static_cast<std::ptrdiff_t>(i)) {
            throw usageError(fmt::format("{} is asked for twice", outputs[i].string()), "a name for each output");
        }
        if (outputs[i] != arguments.web && fs::is_directory(outputs[i])) {
            throw Error(outputs[i], "is a folder", "the name of a file");
        }
        requireDestination(outputs[i], arguments.force);
    }
    // A name that is mistyped should not take away a folder of something else.
    if (arguments.force && fs::is_directory(arguments.web) && !fs::is_empty(arguments.web) &&
        !fs::exists(arguments.web / "info.json")) {
        throw Error(arguments.web, "is a folder of something else", "a new name, or one that --rti-web wrote");
    }
}

} // namespace

void ExportArguments::addTo(CLI::App& command)
{
    command.add_option("SURFACE", surface, "Folder NAME.nacre that acquire wrote")->required();
    command.add_option("--ptm", ptm, "Polynomial texture map: FILE.ptm")->option_text("FILE");
    command.add_option("--ptm-format", ptmFormat, "lrgb (one biquadratic and a colour a pixel) or rgb")
        ->capture_default_str();
    command.add_option("--rti-web", web, "Folder of info.json and plane_N.jpg, as OpenLIME and relight show it")
        ->option_text("DIR");
    command.add_option("--basis", basis, "Of --rti-web: hsh (nine terms) or ptm (six)")->capture_default_str();
    command.add_option("--write-normals", normals, "FILE.png (16 bits, (n + 1) / 2) or FILE.exr")->option_text("FILE");
    command.add_option("--albedo", albedo, "Colour without shading and gloss: FILE.png (16 bits) or FILE.exr")
        ->option_text("FILE");
    command.add_option("--lights", lights, "Virtual lights that --ptm and --rti-web are fitted to")
        ->capture_default_str();
    command.add_option("--exposure", exposure,
                       "Stops of --ptm and --rti-web (default: 99th percentile over all lights at 0.9)");
    command.add_flag("--shadows", shadows, "Lights cast shadows by the surface's height");
    command.add_option("--size", size, "WIDTHxHEIGHT that the surface is fitted into (default: its own)");
    command.add_option("--threads", threads, "Threads (default: all)");
    command.add_flag("--quiet", quiet, "No summary");
    command.add_flag("--force", force, "Replace outputs that exist");
}

void ExportArguments::check() const
{
    requireChoices(*this);
    requireOutputs(*this);
}

} // namespace nacre
