#include "app/report/acquire_report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "acquisition/chain/acquire.h"
#include "app/report/acquisition_summary.h"
#include "app/report/debug_pictures.h"
#include "app/report/plain_verdict.h"
#include "app/report/report_figures.h"
#include "engine/files/whole_file.h"
#include "evaluation/charts/html_page.h"
#include "evaluation/held_out/capture_review.h"
#include "shared/false_colour.h"

namespace nacre {

namespace {

constexpr const char* kSeenColour = "#9a9a9a";
// Of verdicts; the blue and orange are those of the lights' figure.
constexpr const char* kUsedColour = "#c8c8c8";
constexpr const char* kShadowColour = "#0072b2";
constexpr const char* kHighlightColour = "#e6b800";
constexpr const char* kSaturatedColour = "#d55e00";

// Root mean square error as a share of the peak, of decibels.
double errorOf(double psnr)
{
    return std::pow(10.0, -psnr / 20);
}

std::string paragraph(const std::string& text, const std::string& kind = "")
{
    return (kind.empty() ? "<p>" : "<p class=\"" + kind + "\">") + escaped(text) + "</p>\n";
}

std::string heading(const std::string& text)
{
    return "<h2>" + escaped(text) + "</h2>\n";
}

// Where the lights stand, and how they were calibrated.
std::string lightSection(const ReportSubject& subject)
{
    const Rig& rig = subject.acquisition.estimate.rig;
    const bool shading = !rig.shadingDisagreement.empty();
    std::vector<std::string> heads = {"photograph", "off the view", "around it", "red", "green", "blue"};
    if (shading) {
        heads.emplace_back("matt sphere off by");
    }
    std::string rows;
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        const glm::vec3 &d = rig.lights[i].direction, &e = rig.lights[i].irradiance;
        std::vector<std::string> cells = {subject.acquisition.surface.lights[i].photograph,
                                          fmt::format("{:.1f}", glm::degrees(std::atan2(std::hypot(d.x, d.y), d.z))),
                                          fmt::format("{:.1f}", glm::degrees(std::atan2(d.y, d.x))),
                                          fmt::format("{:.4g}", e.x),
                                          fmt::format("{:.4g}", e.y),
                                          fmt::format("{:.4g}", e.z)};
        if (shading) {
            cells.push_back(fmt::format("{:.2f}", rig.shadingDisagreement[i]));
        }
        rows += tableRow(cells);
    }
    return heading("Directions and intensities of the lights") +
           paragraph(fmt::format("Directions: {}. Irradiances: {}. Condition number of the directions: {:.1f} "
                                 "(well-spread lights have 1 to 10).",
                                 rig.directionsFrom, rig.irradiancesFrom, rig.condition)) +
           lightFigure(subject.review.photographs) +
           paragraph("Where the lights stand as the object sees them: the viewer in the middle, rings at 30, 60 and 90 "
                     "degrees off the view. Blue: measured with; orange: held back to judge the result.") +
           folded("Directions in degrees, irradiances in the unit of the photographs", tableOf(heads, rows));
}

// How the observations under each light were judged.
std::string verdictSection(const ReportSubject& subject)
{
    const NormalEstimate& estimate = subject.acquisition.estimate;
    std::vector<Bar> bars;
    for (size_t i = 0; i < estimate.verdicts.size(); ++i) {
        const VerdictCounts& v = estimate.verdicts[i];
        const double all = std::max<double>(1, static_cast<double>(v.used + v.shadow + v.highlight + v.saturated));
        const auto share = [&](size_t count) { return static_cast<double>(count) / all; };
        bars.push_back({subject.acquisition.surface.lights[i].photograph,
                        fmt::format("{:.0f} %", 100 * share(v.used)),
                        {{share(v.used), kUsedColour},
                         {share(v.shadow), kShadowColour},
                         {share(v.highlight), kHighlightColour},
                         {share(v.saturated), kSaturatedColour}}});
    }
    return heading("Shadows and highlights found") +
           paragraph("How the object's pixels were judged in each photograph; the number is the share that the normals "
                     "explain.") +
           barFigure(bars, 1,
                     {{kUsedColour, "explained"},
                      {kShadowColour, "shadow"},
                      {kHighlightColour, "highlight"},
                      {kSaturatedColour, "saturated"}});
}

// How well every photograph is predicted.
std::string predictionSection(const ReportSubject& subject)
{
    std::vector<Bar> bars;
    double longest = 1e-6;
    for (const ReviewedPhotograph& p : subject.review.photographs) {
        const char* own = p.isDiscordant ? kSaturatedColour : p.isGiven ? kSeenColour : kShadowColour;
        if (p.heldOutPsnr) {
            bars.push_back(
                {p.name, fmt::format("{:.1f} dB", *p.heldOutPsnr), {{errorOf(*p.heldOutPsnr), kShadowColour}}});
        }
        bars.push_back({p.heldOutPsnr ? "" : p.name,
                        p.heldOutPsnr ? "" : fmt::format("{:.1f} dB", p.psnr),
                        {{errorOf(p.psnr), own}}});
        longest = std::max({longest, errorOf(p.psnr), p.heldOutPsnr ? errorOf(*p.heldOutPsnr) : 0});
    }
    return heading("Error of every photograph's re-rendering") +
           paragraph(fmt::format(
               "Root mean square error of the radiance under the photograph's own light; the longest bar is {:.2g} % "
               "of the peak, the number is the PSNR in dB. {}",
               100 * longest, subject.review.heldOut)) +
           barFigure(bars, longest,
                     {{kShadowColour, "held back: prediction"},
                      {kSeenColour, "measured with: fit"},
                      {kSaturatedColour, "left out"}});
}

struct ReportPicture {
    std::string data; // as the address of an <img>
    std::string caption;
};

// Pictures as text within a page, each written into a temporary folder on the way.
class ReportPictures {
public:
    ReportPicture photograph(const Image& picture, const std::string& caption); // JPEG

    // Normals, confidence, and labels where there are several materials; cut to the object.
    std::vector<ReportPicture> ofSurface(const Capture& capture, const Acquisition& acquisition);
    // Each on a sphere under one light from the upper left.
    std::vector<ReportPicture> ofMaterials(const std::vector<Material>& materials);

private:
    ReportPicture png(const Image& picture, const std::string& caption);

    TemporaryFolder folder_;
};

constexpr int kSide = 480; // pixels, of pictures that show the surface

ReportPicture ReportPictures::photograph(const Image& picture, const std::string& caption)
{
    const std::filesystem::path file = folder_.path() / "picture.jpg";
    saveImage(file, picture, PixelType::uint8);
    return {dataUri(file, "jpeg"), caption};
}

ReportPicture ReportPictures::png(const Image& picture, const std::string& caption)
{
    const std::filesystem::path file = folder_.path() / "picture.png";
    saveImage(file, picture, PixelType::uint8);
    return {dataUri(file, "png"), caption};
}

std::vector<ReportPicture> ReportPictures::ofSurface(const Capture& capture, const Acquisition& acquisition)
{
    const NormalMap& normals = acquisition.surface.normals;
    Image colours(normals.width, normals.height, 3), confidence(normals.width, normals.height, 3),
        labels(normals.width, normals.height, 3);
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            const size_t i = normals.index(x, y);
            const uint8_t label = acquisition.surface.labels[i];
            confidence.setRgb(x, y, glm::vec3(normals.confidence[i]));
            if (normals.confidence[i] > 0) {
                colours.setRgb(x, y, 0.5f * normals.normals[i] + 0.5f);
            }
            if (label != Surface::kNoMaterial) {
                labels.setRgb(x, y, labelColour(label));
            }
        }
    }
    std::vector<ReportPicture> pictures{
        png(thumbnailOf(colours, capture, kSide), "normals: red, green, blue are (x, y, z), -1 to 1"),
        png(thumbnailOf(confidence, capture, kSide), "confidence: black 0, white 1")};
    if (acquisition.surface.materials.size() > 1) {
        pictures.push_back(png(thumbnailOf(labels, capture, kSide), "materials"));
    }
    return pictures;
}

std::vector<ReportPicture> ReportPictures::ofMaterials(const std::vector<Material>& materials)
{
    std::vector<ReportPicture> pictures;
    for (const Material& material : materials) {
        pictures.push_back(png(ballPicture(material.table), material.name + " on a sphere, lit from the upper left"));
    }
    return pictures;
}

constexpr const char* kReport = "report.html";

std::string overview(const ReportSubject& subject)
{
    const Capture& capture = subject.capture;
    const NormalEstimate& estimate = subject.acquisition.estimate;
    double seconds = 0;
    for (const StageTime& time : estimate.times) {
        seconds += time.seconds;
    }
    const bool absolute = subject.acquisition.surface.scale == RadianceScale::absolute;
    std::string html = listOf(
        {{"photographs", fmt::format("{} of {}x{} pixels, {} used", capture.photographs.size(), capture.width,
                                     capture.height, estimate.given.size())},
         {"object", fmt::format("{} pixels, {} without a normal", capture.maskPixels, estimate.pixelsWithoutNormal)},
         {"method of the normals", nameOf(estimate.report.method)},
         {"scale of the BRDF", absolute ? "absolute, 1/sr" : "relative, up to one factor"},
         {"time", fmt::format("{:.1f} seconds", seconds)}});
    html = paragraph(plainVerdict(estimate), "") + html;
    for (const auto* findings : {&estimate.rig.warnings, &estimate.report.findings}) {
        for (const Finding& finding : *findings) {
            const bool standsOut = isWarning(finding.code) || finding.code == FindingCode::photographsLeftOut;
            html += paragraph(lineOf(finding), standsOut ? "warning" : "");
        }
    }
    return html;
}

std::string figure(const std::string& picture, const std::string& caption)
{
    return "<figure><img src=\"" + picture + "\" alt=\"" + escaped(caption) + "\"><figcaption>" + escaped(caption) +
           "</figcaption></figure>\n";
}

std::string sheetOf(const std::vector<ReportPicture>& pictures, const char* kind)
{
    std::string html = fmt::format("<div class=\"{}\">\n", kind);
    for (const ReportPicture& picture : pictures) {
        html += figure(picture.data, picture.caption);
    }
    return html + "</div>\n";
}

// Steps by bytes, those alone that are better than every smaller one, and the one taken.
std::string ladderTable(const ModelLadder& ladder)
{
    std::string rows;
    double best = -INFINITY;
    for (size_t i = 0; i < ladder.steps.size(); ++i) {
        const LadderStep& step = ladder.steps[i];
        const bool taken = ladder.taken == i;
        if (step.psnr > best || taken) {
            rows += tableRow({step.description, std::to_string(step.bytes), fmt::format("{:.1f}", step.psnr),
                              fmt::format("{:.0f}", step.nanoseconds), taken ? "taken" : ""},
                             taken ? "default" : "");
            best = std::max(best, step.psnr);
        }
    }
    const std::string table = tableOf({"model", "bytes", "PSNR, dB", "ns a lookup", ""}, rows);
    if (!ladder.taken) {
        return paragraph("No smaller model is good enough: the full table stays.") + folded("Models tried", table);
    }
    const LadderStep& taken = ladder.steps[*ladder.taken];
    return paragraph(fmt::format("Taken: {}, {} bytes, {:.1f} dB against the interpolated samples.", taken.description,
                                 taken.bytes, taken.psnr)) +
           folded("Models tried that are better than every smaller one", table);
}

std::string materials(const ReportSubject& subject, const std::vector<ReportPicture>& pictures)
{
    const Acquisition& acquisition = subject.acquisition;
    std::string html =
        heading("Reflectance (BRDF)") +
        paragraph(fmt::format(
            "{} observations (of one pixel under one light) used; left out: {} in shadow or grazing, {} saturated.",
            acquisition.samples.used, acquisition.samples.shadowed, acquisition.samples.saturated)) +
        sheetOf(pictures, "sheet large");
    for (size_t i = 0; i < acquisition.surface.materials.size(); ++i) {
        const Material& material = acquisition.surface.materials[i];
        html += "<h3>" + escaped(material.name) + "</h3>\n" + coverageFigure(material.table) +
                paragraph(
                    "Blue: measured; paler where less of the third coordinate was, light grey where nothing. Table: " +
                    describe(material.table) + ".");
        const ModelLadder& ladder = acquisition.fits[i].ladder;
        html += ladder.steps.empty() ? paragraph(fmt::format("The full table is kept, {} bytes; --tolerance or "
                                                             "--budget-bytes looks for a smaller model.",
                                                             bytesOf(material)))
                                     : ladderTable(ladder);
    }
    return html;
}

} // namespace

std::string reportOf(const ReportSubject& subject)
{
    std::vector<ReportPicture> photographs;
    ReportPictures pictures;
    for (const ReviewedPhotograph& photograph : subject.review.photographs) {
        photographs.push_back(pictures.photograph(photograph.thumbnail, photograph.name));
    }
    std::string html = pageHead("Nacre: " + subject.capture.name, subject.capture.name) + overview(subject);
    html +=
        heading("Surface normals") + sheetOf(pictures.ofSurface(subject.capture, subject.acquisition), "sheet large") +
        predictionSection(subject) + materials(subject, pictures.ofMaterials(subject.acquisition.surface.materials)) +
        lightSection(subject) + verdictSection(subject) + heading("Photographs") + sheetOf(photographs, "sheet");
    return html + kPageEnd;
}

void saveReport(const std::filesystem::path& folder, const std::string& html)
{
    makeDebugFolder(folder);
    writeTextFile(folder / kReport, html);
}

} // namespace nacre
