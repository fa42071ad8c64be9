#include "app/arguments/capture_arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "acquisition/chain/curve_choice.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/materials/material_specification.h"

namespace nacre {

namespace {

// Headings of --help below the options that most need.
constexpr const char* kPhotographs = "Photographs";
constexpr const char* kLights = "Lights";
constexpr const char* kNormals = "Normals";
constexpr const char* kRunning = "Running";

constexpr int kLargestShrink = 4; // as capture.json's scale

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

std::optional<double> lightDistanceOf(const std::string& text)
{
    if (text.empty() || text == "auto") {
        return {};
    }
    if (text == "far") {
        return std::numeric_limits<double>::infinity();
    }
    const std::optional<double> widths = parseNumber(text);
    if (!widths || !(*widths > 0)) {
        throw Error("", fmt::format("--light-distance {} is not understood", text),
                    "a number of object widths above 0, far or auto", Error::kUsage);
    }
    return widths;
}

void requireLength(const std::optional<double>& width)
{
    if (width && !(*width > 0)) {
        throw Error("", fmt::format("--object-width {:g} is not possible", *width), "a length above 0", Error::kUsage);
    }
}

void requireView(const std::optional<double>& degrees)
{
    if (degrees && !(*degrees > 0 && *degrees <= kWidestView)) {
        throw Error("", fmt::format("--field-of-view {:g} is not possible", *degrees),
                    fmt::format("degrees above 0, {:g} at most", kWidestView), Error::kUsage);
    }
}

void requireResolution(const std::optional<double>& pixels)
{
    if (pixels && !(*pixels > 0 && std::isfinite(*pixels))) {
        throw Error("", fmt::format("--pixels-per-mm {:g} is not possible", *pixels), "a number above 0",
                    Error::kUsage);
    }
}

// X,Y,R in pixels; empty where none is asked for.
std::optional<Circle> circleOf(const std::vector<double>& values)
{
    if (!values.empty() && (values.size() != 3 || !(values[2] > 0))) {
        throw Error("", "--circle is not understood", "X,Y,R in pixels, R above 0", Error::kUsage);
    }
    return values.empty() ? std::nullopt : std::optional(Circle{values[0], values[1], values[2]});
}

FileWindow windowOf(const std::vector<int>& crop, int shrink)
{
    const bool isWindow = crop.size() == 4 && crop[0] >= 0 && crop[1] >= 0 && crop[2] > 0 && crop[3] > 0;
    if (!crop.empty() && !isWindow) {
        throw Error("", "--crop is not understood", "X,Y,W,H in whole pixels, at least 1 x 1", Error::kUsage);
    }
    if (shrink < 1 || shrink > kLargestShrink) {
        throw Error("", fmt::format("--shrink {} is not possible", shrink), fmt::format("1 to {}", kLargestShrink),
                    Error::kUsage);
    }
    FileWindow window;
    if (isWindow) {
        window = {crop[0], crop[1], crop[2], crop[3]};
    }
    window.box = shrink;
    return window;
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

TransferCurve curveFromName(const std::string& name)
{
    if (name != "linear" && name != "srgb") {
        throw Error("", fmt::format("--transfer {} is no curve", name), "linear or srgb", Error::kUsage);
    }
    return name == "srgb" ? TransferCurve::srgb : TransferCurve::linear;
}

void CalibrationArguments::addTo(CLI::App& command)
{
    command.add_option("CAPTURE", folder, "Folder of photographs")->required();
    command
        .add_option(
            "--mirror-sphere", mirrorSpheres,
            "Mirror sphere, for directions of the lights: folder of its photographs, or box in the capture's own; "
            "several boxes, one each, for the lights' places")
        ->allow_extra_args(false)
        ->option_text("DIR|in-picture:X,Y,W,H[,MASK]");
    command
        .add_option("--diffuse-sphere", capture.diffuseSphere,
                    "Diffuse sphere, for intensities of the lights: folder of its photographs, or box in the capture's "
                    "own")
        ->option_text("DIR|in-picture:X,Y,W,H[,MASK]");
    command.add_option("--rig", capture.rig, "File of lights: .lp, table of numbers, or JSON of nacre calibrate")
        ->option_text("FILE");
    command.add_option("--mask", capture.mask, "Picture that is white on the object")->option_text("FILE");
    command.add_flag("--force", force, "Replacement of existing outputs");
    command
        .add_option("--sphere-reflectance", sphereReflectance,
                    "Reflectance of the diffuse sphere in (0,1], for a BRDF in absolute units: R,G,B or one value")
        ->delimiter(',')
        ->option_text("R,G,B")
        ->group(kLights);
    command.add_option("--compare-rig", compareRig, "File of lights to compare the directions with, in degrees")
        ->option_text("FILE")
        ->group(kLights);
    command
        .add_option("--light-distance", lightDistance,
                    "Distance of the lights from the object's middle in widths of the object; far: distant; auto: "
                    "`normals` finds it where the photographs tell (default: that of capture.json, else auto)")
        ->option_text("WIDTHS|far|auto")
        ->group(kLights);
    command
        .add_option("--object-width", capture.objectWidth,
                    "Width of the object in the unit of the lights' vectors, which are then their places")
        ->option_text("LENGTH")
        ->group(kLights);
    command
        .add_option(
            "--field-of-view", capture.fieldOfView,
            "Degrees that the photographs' width covers (default: that of capture.json, else the camera is far)")
        ->option_text("DEGREES")
        ->group(kPhotographs);
    command
        .add_option("--transfer", transfer,
                    "Transfer curve of the photographs (default: as the files declare; else sRGB for JPEG and linear "
                    "for others, unless the photographs of 8 bits tell)")
        ->option_text("linear|srgb")
        ->group(kPhotographs);
    command
        .add_option("--offset", offset,
                    "Offset subtracted from every value, 0 to 1; auto estimates it from shadows (default: that of "
                    "capture.json, else none)")
        ->option_text("VALUE|auto|none")
        ->group(kPhotographs);
    command.add_option("--ambient", capture.ambient, "Photograph without the lights, subtracted from all others")
        ->option_text("FILE")
        ->group(kPhotographs);
    command.add_option("--crop", crop, "Part of the photographs to read, in pixels")
        ->delimiter(',')
        ->option_text("X,Y,W,H")
        ->group(kPhotographs);
    command.add_option("--shrink", shrink, "Boxes of so many pixels squared become one, 1 to 4")
        ->option_text("N [1]")
        ->group(kPhotographs);
    command
        .add_option("--pixels-per-mm", capture.pixelsPerMillimetre,
                    "Pixels of the photographs a millimetre of the object, for `render --scale-bar`")
        ->option_text("NUMBER")
        ->group(kPhotographs);
    command.add_option("--circle", circle, "Outline of the mirror sphere, in place of its mask, in pixels")
        ->delimiter(',')
        ->option_text("X,Y,R")
        ->group(kLights);
    command.add_option("--skip", capture.skip, "Photographs to leave out")
        ->delimiter(',')
        ->option_text("NAME[,NAME]")
        ->group(kPhotographs);
    command.add_option("--threads", threads, "Number of threads (default: all)")->group(kRunning);
    command.add_flag("--quiet", quiet, "No progress and no summary")->group(kRunning);
}

void CaptureArguments::addTo(CLI::App& command)
{
    CalibrationArguments::addTo(command);
    command.add_option("--normals", normals, "Method of the normals: " + normalMethodNames())
        ->option_text("METHOD [" + normals + "]");
    command
        .add_option("--lights-given", lightsGiven,
                    "Number of photographs to read, 3 or more, whose lights spread best (default: all)")
        ->option_text("K")
        ->group(kPhotographs);
    command
        .add_option("--smooth", capture.smooth,
                    "Picture that is white where normals are smoothed in from around instead of estimated")
        ->option_text("FILE")
        ->group(kPhotographs);
    command
        .add_option("--intensities", intensities,
                    "Intensities of the lights: auto corrects those that other photographs contradict and estimates "
                    "missing ones, given does not")
        ->option_text("auto|given [" + intensities + "]")
        ->group(kLights);
    command
        .add_option("--self-light", selfLight,
                    "Light that the object throws on itself: auto takes it out for the methods auto and exemplar where "
                    "unlit sides show it, off does not")
        ->option_text("auto|off [" + selfLight + "]")
        ->group(kNormals);
    command
        .add_option("--thresholds", thresholds,
                    "Range of radiance over irradiance that `threshold` keeps (default: shares of each pixel's own)")
        ->delimiter(',')
        ->option_text("LOW,HIGH")
        ->group(kNormals);
    command.add_option("--triples", triples, "Largest number of light triples in two-step, ransac and consensus")
        ->capture_default_str()
        ->group(kNormals);
    command.add_option("--seed", seed, "Seed of the choice of triples")->capture_default_str()->group(kNormals);
    command
        .add_option("--fits", fits,
                    "Folder of published fits for exemplars, beside the built-in ones (default: $NACRE_FITS_DIR)")
        ->option_text("DIR")
        ->group(kNormals);
    command.add_option("--exclude-reflectance", excludedReflectances, "Published fits to leave out")
        ->delimiter(',')
        ->option_text("NAME[,NAME]")
        ->group(kNormals);
    command.add_option("--json", json, "File for the summary as JSON")->option_text("OUT.json")->group(kRunning);
    command.add_option("--debug-dir", debugFolder, "Folder for a picture of every stage's result")
        ->option_text("OUT")
        ->group(kRunning);
}

Capture CalibrationArguments::load()
{
    if (!transfer.empty()) {
        capture.transfer = curveFromName(transfer);
    }
    if (!offset.empty()) {
        capture.offset = offsetChoiceOf(offset);
    }
    capture.lightDistance = lightDistanceOf(lightDistance);
    requireLength(capture.objectWidth);
    if (capture.objectWidth && capture.lightDistance) {
        throw Error(
            "", fmt::format("--object-width and --light-distance {} are two accounts of the lights", lightDistance),
            "one of them: a width in the unit of the lights' places, or their distance in widths", Error::kUsage);
    }
    requireView(capture.fieldOfView);
    requireResolution(capture.pixelsPerMillimetre);
    capture.circle = circleOf(circle);
    capture.window = windowOf(crop, shrink);
    if (!mirrorSpheres.empty()) {
        capture.mirrorSphere = mirrorSpheres.front();
        capture.moreMirrorSpheres = {mirrorSpheres.begin() + 1, mirrorSpheres.end()};
    }
    capture.needsLights = true;
    const Capture loaded = loadCapture(folder, capture);
    AcquireOptions options;
    options.calibration = calibrationOptions();
    options.setThreads(threads);
    return withToldCurve(loaded, options);
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
    if (selfLight != "auto" && selfLight != "off") {
        throw Error("", fmt::format("--self-light {} is no choice", selfLight), "auto or off", Error::kUsage);
    }
    options.removeSelfLight = selfLight == "auto";
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
