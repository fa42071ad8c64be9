#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "acquisition/capture/picture_files.h"
#include "acquisition/lights/well_spread_lights.h"
#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/acquisition_summary.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/lights/light_files.h"

namespace nacre {

namespace {

struct CalibrateArguments {
    CalibrationArguments common;
    std::filesystem::path output;
};

bool isLp(const std::filesystem::path& file)
{
    return lowerCase(file.extension().string()) == ".lp";
}

void checkOutput(const std::filesystem::path& output, bool force)
{
    if (!isLp(output) && lowerCase(output.extension().string()) != ".json") {
        throw Error(output, "names no file of lights", "NAME.json (directions and irradiances) or NAME.lp (directions)",
                    Error::kUsage);
    }
    requireFile(output, force);
}

LightFile lightFileOf(const Capture& capture, const Rig& rig)
{
    LightFile file;
    file.lights = rig.lights;
    file.irradianceGiven = capture.irradianceGiven || capture.diffuseSphere.has_value();
    std::transform(capture.photographs.begin(), capture.photographs.end(), std::back_inserter(file.photographs),
                   [](const Photograph& photograph) { return photograph.name; });
    return file;
}

std::string describeOutput(const std::filesystem::path& output, const LightFile& lights)
{
    const char* content = "directions and irradiances";
    if (isLp(output)) {
        content = "directions alone, since a .lp file has no place for irradiances";
    } else if (!lights.irradianceGiven) {
        content = "directions alone, since no irradiances are known";
    }
    return fmt::format("\n{}: {} lights, {}\n", output.string(), lights.lights.size(), content);
}

void runCalibrate(CalibrateArguments& arguments)
{
    CalibrationArguments& common = arguments.common;
    const CalibrationOptions options = common.calibrationOptions();
    checkOutput(arguments.output, common.force);
    const Capture capture = common.load();
    const Rig rig = calibrateLights(capture, options);
    const LightFile lights = lightFileOf(capture, rig);
    if (isLp(arguments.output)) {
        saveLpFile(arguments.output, lights);
    } else {
        saveLightFile(arguments.output, lights);
    }
    if (common.quiet) {
        return;
    }
    fmt::print("{}{}", describe(capture), describe(capture, rig));
    if (!common.compareRig.empty()) {
        fmt::print("{}", describeDisagreement(capture, chosenLights(rig.lights, {}), rig, common.compareRig));
    }
    fmt::print("{}", describeOutput(arguments.output, lights));
}

} // namespace

void addCalibrateCommand(CLI::App& app)
{
    auto arguments = std::make_shared<CalibrateArguments>();
    CLI::App* command = app.add_subcommand("calibrate", "The lights of a capture to a file that --rig reads");
    arguments->common.addTo(*command);
    command
        ->add_option("-o,--output", arguments->output,
                     "File to write: NAME.json (directions and irradiances) or NAME.lp (directions alone)")
        ->option_text("OUT.json|OUT.lp")
        ->required();
    command->footer("Example:\n  nacre calibrate gray --mirror-sphere chrome --diffuse-sphere gray -o lights.json\n"
                    "  nacre acquire horse --rig lights.json -o horse.nacre");
    command->callback([arguments] { runCalibrate(*arguments); });
}

} // namespace nacre
