#include "app/arguments/capture_arguments.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/materials/material_specification.h"

namespace nacre {

namespace {

// One value for all channels, or three.
glm::vec3 reflectanceOf(const std::vector<float>& values)
{
    const bool known = std::all_of(values.begin(), values.end(), [](float v) { return v > 0 && v <= 1; });
    if ((values.size() != 1 && values.size() != 3) || !known) {
        throw Error("", "--sphere-reflectance is not understood", "one number or R,G,B in (0, 1]", Error::kUsage);
    }
    return values.size() == 1 ? glm::vec3(values[0]) : glm::vec3(values[0], values[1], values[2]);
}

OffsetChoice offsetChoiceOf(const std::string& text)
{
    if (text == "auto") {
        return {true, 0};
    }
    if (text == "none") {
        return {false, 0};
    }
    const std::optional<double> value = parseNumber(text);
    if (!value || *value < 0 || *value >= 1) {
        throw Error("", fmt::format("--offset {} is not understood", text), "a number from 0 to below 1, auto or none",
                    Error::kUsage);
    }
    return {false, static_cast<float>(*value)};
}

LightChoice lightChoiceOf(const std::optional<int>& given)
{
    if (given && *given < kFewestLightsGiven) {
        throw Error("", fmt::format("--lights-given {} is not possible", *given),
                    fmt::format("{} or more lights", kFewestLightsGiven), Error::kUsage);
    }
    return {given ? static_cast<size_t>(*given) : 0, 0};
}

} // namespace

void CalibrationArguments::addTo(CLI::App& command)
{
    command.add_option("CAPTURE", folder, "Folder of photographs")->required();
    command
        .add_option("--mirror-sphere", capture.mirrorSphere,
                    "Light directions: folder of a mirror sphere's photographs, or where it stands in the capture's "
                    "own, with a mask or found")
        ->option_text("DIR|in-picture:X,Y,W,H[,MASK]");
    command
        .add_option("--diffuse-sphere", capture.diffuseSphere,
                    "Intensities: folder of a diffuse sphere's photographs, or where it stands in the capture's own")
        ->option_text("DIR|in-picture:X,Y,W,H[,MASK]");
    command
        .add_option("--sphere-reflectance", sphereReflectance,
                    "The diffuse sphere's reflectance (one value or R,G,B in (0,1]): makes the BRDF absolute")
        ->delimiter(',');
    command.add_option("--rig", capture.rig, "Lights from a file: .lp, numbers, or Nacre's JSON");
    command.add_option("--compare-rig", compareRig,
                       "Print how far the directions are from those of this file, light by light");
    command.add_option("--mask", capture.mask, "Picture that is white on the object");
    command.add_option("--transfer", transfer,
                       "Curve of the photographs: linear or srgb (default: what the files declare)");
    command
        .add_option("--offset", offset,
                    "Subtracted from every value (0..1): a number, none, or auto to estimate it from shadows "
                    "(default: what capture.json says, else none)")
        ->option_text("VALUE|auto|none");
    command.add_option("--skip", capture.skip, "NAME[,NAME] of photographs to leave out")->delimiter(',');
    command.add_option("--threads", threads, "Threads (default: all)");
    command.add_flag("--quiet", quiet, "No progress, no summary");
    command.add_flag("--force", force, "Replace an output that exists");
}

void CaptureArguments::addTo(CLI::App& command)
{
    CalibrationArguments::addTo(command);
    command.add_option("--normals", normals, "Method: " + normalMethodNames())->capture_default_str();
    command
        .add_option("--thresholds", thresholds,
                    "LOW,HIGH radiance over irradiance that `threshold` keeps (default: each pixel's own shares)")
        ->delimiter(',');
    command
        .add_option("--lights-given", lightsGiven,
                    "Read only so many photographs, 3 or more, whose lights spread best, from the first on (default: "
                    "all)")
        ->option_text("K");
    command
        .add_option(
            "--intensities", intensities,
            "auto corrects photographs that disagree with the rest, and estimates intensities that nobody gave; "
            "given takes them as they are")
        ->capture_default_str();
    command.add_option("--triples", triples, "Of lights that two-step, ransac and consensus try, at most")
        ->capture_default_str();
    command.add_option("--seed", seed, "Of the choice of triples")->capture_default_str();
    command.add_option(
        "--fits", fits,
        "Folder of published fits that exemplars use beside the built-in ones [environment variable NACRE_FITS_DIR]");
    command.add_option("--exclude-reflectance", excludedReflectances, "NAME[,NAME] of published fits to leave out")
        ->delimiter(',');
    command.add_option(
        "--smooth", capture.smooth,
        "Picture that is white where normals are to be smoothed in from their neighbours, not estimated");
    command.add_option("--json", json, "Write the summary to this file too");
    command.add_option("--debug-dir", debugFolder, "Write every stage's result as a picture");
}

Capture CalibrationArguments::load()
{
    if (!transfer.empty() && transfer != "linear" && transfer != "srgb") {
        throw Error("", fmt::format("--transfer {} is no curve", transfer), "linear or srgb", Error::kUsage);
    }
    if (!transfer.empty()) {
        capture.transfer = transfer == "srgb" ? TransferCurve::srgb : TransferCurve::linear;
    }
    if (!offset.empty()) {
        capture.offset = offsetChoiceOf(offset);
    }
    return loadCapture(folder, capture);
}

CalibrationOptions CalibrationArguments::calibrationOptions() const
{
    CalibrationOptions options;
    if (!sphereReflectance.empty()) {
        options.sphereReflectance = reflectanceOf(sphereReflectance);
    }
    if (threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", threads), "1 or more, or 0 for all", Error::kUsage);
    }
    options.threads = threads;
    return options;
}

AcquireOptions CaptureArguments::stageOptions() const
{
    AcquireOptions options;
    options.normals.method = normalMethodFromName(normals);
    if (intensities != "auto" && intensities != "given") {
        throw Error("", fmt::format("--intensities {} is no choice", intensities), "auto or given", Error::kUsage);
    }
    options.correctIntensities = intensities == "auto";
    options.lights = lightChoiceOf(lightsGiven);
    if (lightsGiven && !compareRig.empty()) {
        throw Error("", "--compare-rig is not possible with --lights-given", "one of them: a rig has every light",
                    Error::kUsage);
    }
    options.normals.seed = seed;
    options.normals.fitsFolder = fitsFolderFrom(fits);
    options.normals.excludedReflectances = excludedReflectances;
    options.keepVerdicts = !debugFolder.empty();
    if (triples < 1 || triples > 100000) {
        throw Error("", fmt::format("--triples {} is out of range", triples), "1 to 100000", Error::kUsage);
    }
    options.normals.triples = triples;
    if (!thresholds.empty()) {
        if (thresholds.size() != 2 || thresholds[0] < 0 || thresholds[1] <= thresholds[0]) {
            throw Error("", "--thresholds is not understood", "two numbers LOW,HIGH with 0 <= LOW < HIGH",
                        Error::kUsage);
        }
        options.normals.lowThreshold = thresholds[0];
        options.normals.highThreshold = thresholds[1];
    }
    options.calibration = calibrationOptions();
    options.setThreads(threads);
    return options;
}

} // namespace nacre
