#include "app/report/acquisition_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "acquisition/brdf/model_ladder.h"
#include "acquisition/capture/capture_layouts.h"
#include "app/arguments/model_arguments.h"
#include "app/report/brdf_report.h"
#include "app/report/plain_verdict.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/lights/light_files.h"

namespace nacre {
using Json = nlohmann::json;

namespace {

// The steps that are better than every smaller one, with the one that is taken; the others are counted.
// empty where none was asked for
std::string describe(const ModelLadder& ladder)
{
    if (ladder.steps.empty()) {
        return {};
    }
    std::string text = "model                                bytes   PSNR dB  ns a lookup\n";
    double best = -std::numeric_limits<double>::infinity();
    size_t others = 0;
    for (size_t i = 0; i < ladder.steps.size(); ++i) {
        const LadderStep& step = ladder.steps[i];
        const bool taken = ladder.taken == i;
        if (step.psnr <= best && !taken) {
            ++others;
            continue;
        }
        text += fmt::format("  {:<30} {:>9} {:>9.1f} {:>12.0f}{}\n", step.description, step.bytes, step.psnr,
                            step.nanoseconds, taken ? "  <- taken" : "");
        best = std::max(best, step.psnr);
    }
    return text + (others > 0 ? fmt::format("  {} others, no better than a smaller one\n", others) : "") +
           (ladder.taken ? "" : "  none of them is good enough: the full table stays\n");
}

double polarDegrees(const glm::vec3& d)
{
    return glm::degrees(std::atan2(std::hypot(d.x, d.y), d.z));
}

double azimuthDegrees(const glm::vec3& d)
{
    return glm::degrees(std::atan2(d.y, d.x));
}

// By code; without a limit null.
Json jsonOf(const std::vector<CheckFigure>& figures)
{
    Json checks = Json::object();
    for (const CheckFigure& figure : figures) {
        checks[std::string(nameOf(figure.code))] = {{"value", figure.value}, {"limit", figure.limit}};
    }
    return checks;
}

double meanOf(const std::vector<float>& values)
{
    double sum = 0;
    for (const float v : values) {
        sum += v;
    }
    return sum / static_cast<double>(values.size());
}

std::string describeMaterials(const Acquisition& acquisition)
{
    const Segmentation& segmentation = acquisition.segmentation;
    if (segmentation.source.empty()) {
        return "";
    }
    std::string text = fmt::format("materials    {}, labels {}\n", segmentation.regions.size(), segmentation.source);
    for (const MaterialRegion& region : segmentation.regions) {
        text += fmt::format("             {}: {} pixels, {} of them at no border\n", region.name, region.pixels,
                            region.inner);
    }
    return text;
}

std::string describeTables(const Acquisition& acquisition)
{
    std::string text;
    for (size_t i = 0; i < acquisition.fits.size(); ++i) {
        const Material& material = acquisition.surface.materials[i];
        text += describe(acquisition.fits[i].interpolation) + describe(acquisition.fits[i].ladder) +
                fmt::format("table        {}{}\n", describe(material.table),
                            acquisition.fits.size() > 1 ? " (" + material.name + ")" : "");
    }
    return text;
}

} // namespace

std::string describe(const Capture& capture)
{
    size_t exposures = 0;
    for (const Photograph& photograph : capture.photographs) {
        exposures += photograph.exposures.size();
    }
    std::string text = fmt::format("capture      {}: {} layout, {} photographs of {}x{}", capture.folder.string(),
                                   describe(capture.layout), capture.photographs.size(), capture.width, capture.height);
    if (exposures > capture.photographs.size()) {
        text += fmt::format(" from {} exposures", exposures);
    }
    if (!capture.skipped.empty()) {
        text += fmt::format("\nskipped      {}", fmt::join(capture.skipped, ", "));
    }
    const FileWindow& window = capture.window;
    if (capture.width != window.fileWidth || capture.height != window.fileHeight) {
        text +=
            fmt::format("\nwindow       {}x{} from ({}, {}) of {}x{}, {}x{} pixels averaged to one", window.width,
                        window.height, window.x, window.y, window.fileWidth, window.fileHeight, window.box, window.box);
    }
    if (capture.viewByExif && !capture.fieldOfView) {
        text += fmt::format("\nlens         {0:.1f} degrees wide by EXIF, taken for a distant one's (--field-of-view "
                            "{0:.1f} counts with it)",
                            *capture.viewByExif);
    }
    if (!capture.offsetSource.empty()) {
        text += fmt::format("\noffset       {:.4f} subtracted ({})", capture.offset, capture.offsetSource);
    }
    if (capture.ambient) {
        text += fmt::format("\nambient      {} subtracted; noise may leave values below 0", capture.ambient->name);
    }
    return text + fmt::format("\nmask         {} pixels ({:.1f} %){}\ncurve        {} ({})\n", capture.maskPixels,
                              100.0 * static_cast<double>(capture.maskPixels) / (1.0 * capture.width * capture.height),
                              capture.maskSource.empty() ? "" : ", " + capture.maskSource, capture.curve.name,
                              capture.curveSource);
}

std::string describe(const Capture& capture, const Rig& rig)
{
    std::string text = fmt::format("directions   {}\nirradiances  {}\ncondition    {:.1f}\n", rig.directionsFrom,
                                   rig.irradiancesFrom, rig.condition);
    const bool shading = !rig.shadingDisagreement.empty();
    text += fmt::format("\n{:>24} {}{}\n", "photograph", kLightColumns, shading ? "  shading off by" : "");
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        text += fmt::format("{:>24} {}", capture.photographs[i].name, describe(rig.lights[i]));
        text += shading ? fmt::format("  {:.2f} degrees\n", rig.shadingDisagreement[i]) : "\n";
    }
    if (shading) {
        text += fmt::format(
            "\nthe diffuse sphere's own shading puts the lights {:.2f} degrees elsewhere in the mean, {:.2f} at most\n",
            meanOf(rig.shadingDisagreement),
            *std::max_element(rig.shadingDisagreement.begin(), rig.shadingDisagreement.end()));
        text += fmt::format("its shading has an offset of {:.4f}\n", rig.shadingOffset);
    }
    for (const Finding& warning : rig.warnings) {
        text += lineOf(warning) + "\n";
    }
    return text;
}

std::string describeGiven(const Capture& capture, const NormalEstimate& estimate)
{
    const size_t given = estimate.given.size() + estimate.leftOut.size();
    return given == capture.photographs.size()
               ? ""
               : fmt::format("given        {} of {} photographs, the best spread ones from {} on\n", given,
                             capture.photographs.size(), capture.photographs[estimate.given.front()].name);
}

std::string describeDisagreement(const Capture& capture, const std::vector<size_t>& given, const Rig& rig,
                                 const std::filesystem::path& otherLights)
{
    const LightFile other = loadLightFile(otherLights);
    std::vector<size_t> order = lightsByName(other, capture.photographs, otherLights);
    const bool named = !order.empty();
    if (!named && other.lights.size() != capture.photographs.size()) {
        throw Error(otherLights, fmt::format("has {} lights", other.lights.size()),
                    fmt::format("one for each of the {} photographs", capture.photographs.size()));
    }
    if (!named) {
        order.resize(other.lights.size());
        std::iota(order.begin(), order.end(), size_t{0});
    }
    std::string text = fmt::format("\ndirections against {}, matched to the photographs by {}\n", otherLights.string(),
                                   named ? "name" : "order");
    std::vector<float> degrees;
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        const Light& light = other.lights[order[given[i]]];
        degrees.push_back(static_cast<float>(degreesBetween(rig.lights[i].direction, light.direction)));
        text += fmt::format("{:>24} {:7.2f} degrees\n", capture.photographs[given[i]].name, degrees.back());
    }
    return text + fmt::format("{:.2f} degrees in the mean, {:.2f} at most\n", meanOf(degrees),
                              *std::max_element(degrees.begin(), degrees.end()));
}

std::string describe(const std::vector<StageTime>& times)
{
    std::string text = "seconds     ";
    for (const StageTime& time : times) {
        text += fmt::format(" {} {:.2f}", time.stage, time.seconds);
    }
    return text + "\n";
}

std::string describeNormals(const Capture& capture, const NormalEstimate& estimate)
{
    std::string text =
        fmt::format("\nnormals      {} by {}, {} pixels without one, {} lit by fewer than three lights\n",
                    capture.maskPixels - estimate.pixelsWithoutNormal, nameOf(estimate.report.method),
                    estimate.pixelsWithoutNormal, estimate.pixelsInShade);
    for (const Finding& finding : estimate.report.findings) {
        text += fmt::format("             {}\n", lineOf(finding));
    }
    if (estimate.pixelsSmoothed > 0) {
        text += fmt::format("smoothed in  {} pixels that the capture marks\n", estimate.pixelsSmoothed);
    }
    if (std::isfinite(estimate.report.lambertianMisfit)) {
        text += fmt::format("misfit       {:.2f} % of the mean: Lambert's law on lit pixels, root mean square\n",
                            100 * estimate.report.lambertianMisfit);
    }
    VerdictCounts sum;
    for (const VerdictCounts& counts : estimate.verdicts) {
        sum.used += counts.used;
        sum.shadow += counts.shadow;
        sum.highlight += counts.highlight;
        sum.saturated += counts.saturated;
    }
    const double percent =
        100.0 / static_cast<double>(std::max<size_t>(1, capture.maskPixels * estimate.verdicts.size()));
    return text +
           fmt::format("verdicts     {:.1f} % explained, {:.1f} % shadow, {:.1f} % highlight, {:.2f} % saturated\n",
                       percent * static_cast<double>(sum.used), percent * static_cast<double>(sum.shadow),
                       percent * static_cast<double>(sum.highlight), percent * static_cast<double>(sum.saturated));
}

std::string describeWarnings(const NormalEstimate& estimate)
{
    std::string text;
    for (const auto* findings : {&estimate.rig.warnings, &estimate.report.findings}) {
        for (const Finding& finding : *findings) {
            text += isWarning(finding.code) ? lineOf(finding) + "\n" : "";
        }
    }
    return text;
}

std::string describeBrdf(const Acquisition& acquisition)
{
    const SampleCounts& counts = acquisition.samples;
    return describeMaterials(acquisition) +
           fmt::format("observations {} used; left out: {} in shadow or grazing, {} saturated, {} of pixels without a "
                       "normal, {} to thin them out\n"
                       "{}{}{}scale        {}\n",
                       counts.used, counts.shadowed, counts.saturated, counts.withoutNormal, counts.thinned,
                       describeTables(acquisition), describe(acquisition.shadows), describe(acquisition.residual),
                       acquisition.surface.scale == RadianceScale::absolute ? "absolute (1/sr)" : "relative");
}

std::string describe(const InterpolationChoice& choice)
{
    if (choice.heldOut == 0) {
        return {};
    }
    return fmt::format("interpolated {} from k = {}, azimuth {:g}, thetaD {:g}: error on {} held-out samples {:.4f} -> "
                       "{:.4f} of the bright level\n",
                       nameOf(choice.options.method), choice.options.k, choice.options.metric.azimuth,
                       choice.options.metric.thetaD, choice.heldOut, choice.firstError, choice.error);
}

namespace {

std::string describeBytes(size_t bytes)
{
    const double kibibytes = static_cast<double>(bytes) / 1024;
    return kibibytes < 1024 ? fmt::format("{:.1f} KiB", kibibytes) : fmt::format("{:.1f} MiB", kibibytes / 1024);
}

} // namespace

std::string describe(const BrdfTable& table)
{
    const std::string domain =
        table.domain.coordinates == kNatural
            ? "natural coordinates"
            : fmt::format("{}, thetaD to {:.1f} degrees", nameOfCoordinates(table.domain.coordinates),
                          glm::degrees(table.domain.thetaDMax));
    return fmt::format("{}x{}x{} ({}), {}, {:.0f} % of it measured, {:.0f} % known to {:.0f} %", table.size.x,
                       table.size.y, table.size.z, describeBytes(16 * table.values.size()), domain,
                       100 * coveredShare(table), 100 * certainShare(table), 100 * kUncertainError);
}

std::string describe(const Light& light)
{
    return fmt::format("{:7.2f} {:8.2f} {:8.4f} {:8.4f} {:8.4f}", polarDegrees(light.direction),
                       azimuthDegrees(light.direction), light.irradiance.x, light.irradiance.y, light.irradiance.z);
}

Json findingsOf(const NormalEstimate& estimate)
{
    Json list = Json::array();
    for (const auto* findings : {&estimate.rig.warnings, &estimate.report.findings}) {
        for (const Finding& finding : *findings) {
            list.push_back(
                {{"code", nameOf(finding.code)}, {"warning", isWarning(finding.code)}, {"text", finding.text}});
        }
    }
    return list;
}

Json summaryOf(const Capture& capture, const NormalEstimate& estimate)
{
    const Rig& rig = estimate.rig;
    Json json = {{"layout", describe(capture.layout)},
                 {"photographs", capture.photographs.size()},
                 {"width", capture.width},
                 {"height", capture.height},
                 {"maskPixels", capture.maskPixels},
                 {"curve", capture.curve == TransferCurve::srgb ? "srgb" : capture.curve.name},
                 {"directionsFrom", rig.directionsFrom},
                 {"irradiancesFrom", rig.irradiancesFrom},
                 {"conditionNumber", rig.condition},
                 {"normals", nameOf(estimate.report.method)},
                 {"findings", findingsOf(estimate)},
                 {"checks", jsonOf(estimate.report.figures)},
                 {"verdict", plainVerdict(estimate)},
                 {"pixelsWithoutNormal", estimate.pixelsWithoutNormal},
                 {"pixelsInShade", estimate.pixelsInShade},
                 {"pixelsSmoothed", estimate.pixelsSmoothed},
                 {"lambertianMisfit", estimate.report.lambertianMisfit}, // null where nothing is lit
                 {"photographsLeftOut", estimate.leftOut},
                 {"photographsGiven", estimate.given.size()},
                 {"lights", Json::array()},
                 {"seconds", Json::object()}};
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        const Light& light = rig.lights[i];
        Json entry = {{"photograph", capture.photographs[i].name},
                      {"direction", {light.direction.x, light.direction.y, light.direction.z}},
                      {"irradiance", {light.irradiance.x, light.irradiance.y, light.irradiance.z}},
                      {"polarDegrees", polarDegrees(light.direction)},
                      {"azimuthDegrees", azimuthDegrees(light.direction)}};
        if (!rig.shadingDisagreement.empty()) {
            entry["shadingDisagreementDegrees"] = rig.shadingDisagreement[i];
        }
        const VerdictCounts& verdicts = estimate.verdicts[i];
        entry["used"] = verdicts.used;
        entry["shadow"] = verdicts.shadow;
        entry["highlight"] = verdicts.highlight;
        entry["saturated"] = verdicts.saturated;
        json["lights"].push_back(entry);
    }
    for (const StageTime& time : estimate.times) {
        json["seconds"][time.stage] = time.seconds;
    }
    return json;
}

Json summaryOf(const Capture& capture, const Acquisition& acquisition)
{
    Json json = summaryOf(capture, acquisition.estimate);
    const BrdfTable& table = acquisition.surface.materials.front().table;
    const SampleCounts& counts = acquisition.samples;
    json["samplesUsed"] = counts.used;
    json["samplesShadowed"] = counts.shadowed;
    json["samplesSaturated"] = counts.saturated;
    json["samplesWithoutNormal"] = counts.withoutNormal;
    json["samplesThinned"] = counts.thinned;
    json["tableSize"] = {table.size.x, table.size.y, table.size.z};
    json["tableCoordinates"] = nameOfCoordinates(table.domain.coordinates);
    json["tableThetaDMaxDegrees"] = glm::degrees(table.domain.thetaDMax);
    json["tableCoveredShare"] = coveredShare(table);
    json["tableCertainShare"] = certainShare(table);
    for (size_t i = 0; i < acquisition.segmentation.regions.size(); ++i) {
        const MaterialRegion& region = acquisition.segmentation.regions[i];
        const BrdfTable& own = acquisition.surface.materials[i].table;
        json["materials"].push_back({{"name", region.name},
                                     {"pixels", region.pixels},
                                     {"innerPixels", region.inner},
                                     {"tableSize", {own.size.x, own.size.y, own.size.z}},
                                     {"tableCoveredShare", coveredShare(own)},
                                     {"tableCertainShare", certainShare(own)}});
    }
    json["shadows"] = documentOf(acquisition.shadows);
    json["residual"] = documentOf(acquisition.residual);
    json["labels"] = acquisition.segmentation.source;
    json["scale"] = acquisition.surface.scale == RadianceScale::absolute ? "absolute" : "relative";
    return json;
}

} // namespace nacre
