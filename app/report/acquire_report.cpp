#include "app/report/acquire_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/report/acquisition_summary.h"
#include "app/report/debug_pictures.h"
#include "app/report/report_figures.h"
#include "app/report/report_pictures.h"
#include "app/report/report_sections.h"
#include "engine/files/whole_file.h"
#include "evaluation/charts/html_page.h"

namespace nacre {

namespace {

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
        {{"photographs", fmt::format("{} of {}x{}, {} given", capture.photographs.size(), capture.width, capture.height,
                                     estimate.given.size())},
         {"object", fmt::format("{} pixels, {} without a normal", capture.maskPixels, estimate.pixelsWithoutNormal)},
         {"normals by", nameOf(estimate.report.method)},
         {"scale of the BRDF", absolute ? "absolute, 1/sr" : "relative, up to one factor"},
         {"seconds", fmt::format("{:.1f}", seconds)}});
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
        return paragraph("No smaller model is good enough: the full table stays.") + folded("What was tried", table);
    }
    const LadderStep& taken = ladder.steps[*ladder.taken];
    return paragraph(fmt::format("Taken: {}, {} bytes, {:.1f} dB against the interpolated samples.", taken.description,
                                 taken.bytes, taken.psnr)) +
           folded("What was tried, as far as it was better than everything smaller", table);
}

std::string materials(const ReportSubject& subject, const std::vector<ReportPicture>& pictures)
{
    const Acquisition& acquisition = subject.acquisition;
    std::string html =
        heading("BRDF") +
        paragraph(fmt::format("{} observations used; left out: {} in shadow or grazing, {} saturated.",
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
    html += heading("Normals") + sheetOf(pictures.ofSurface(subject.capture, subject.acquisition), "sheet large") +
            predictionSection(subject) +
            materials(subject, pictures.ofMaterials(subject.acquisition.surface.materials)) + lightSection(subject) +
            verdictSection(subject) + heading("Photographs") + sheetOf(photographs, "sheet");
    return html + kPageEnd;
}

void requireReportDestination(const std::filesystem::path& folder, bool replace)
{
    requireFolderDestination(folder);
    if (!folder.empty() && std::filesystem::exists(folder / kReport)) {
        requireDestination(folder / kReport, replace);
    }
}

void saveReport(const std::filesystem::path& folder, const std::string& html)
{
    makeDebugFolder(folder);
    writeTextFile(folder / kReport, html);
}

} // namespace nacre
