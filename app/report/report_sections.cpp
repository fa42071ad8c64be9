#include "app/report/report_sections.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "app/report/report_figures.h"
#include "evaluation/charts/html_page.h"

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

} // namespace

std::string paragraph(const std::string& text, const std::string& kind)
{
    return (kind.empty() ? "<p>" : "<p class=\"" + kind + "\">") + escaped(text) + "</p>\n";
}

std::string heading(const std::string& text)
{
    return "<h2>" + escaped(text) + "</h2>\n";
}

std::string lightSection(const ReportSubject& subject)
{
    const Rig& rig = subject.acquisition.estimate.rig;
    const bool shading = !rig.shadingDisagreement.empty();
    std::vector<std::string> heads = {"photograph", "polar", "azimuth", "red", "green", "blue"};
    if (shading) {
        heads.emplace_back("shading off by");
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
    return heading("Lights") +
           paragraph(fmt::format("Directions: {}. Irradiances: {}. Condition of the directions: {:.1f}.",
                                 rig.directionsFrom, rig.irradiancesFrom, rig.condition)) +
           lightFigure(subject.review.photographs) +
           paragraph("Where the lights stand as the object sees them: the viewer in the middle, rings at 30, 60 and 90 "
                     "degrees off the view. Blue: given; orange: they judge.") +
           folded("Directions in degrees, irradiances", tableOf(heads, rows));
}

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
    return heading("Verdicts") +
           paragraph("How the pixels under each light were judged; the figure is the share that the normals explain.") +
           barFigure(bars, 1,
                     {{kUsedColour, "explained"},
                      {kShadowColour, "shadow"},
                      {kHighlightColour, "highlight"},
                      {kSaturatedColour, "saturated"}});
}

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
    return heading("Prediction of every photograph") +
           paragraph(
               fmt::format("Root mean square error of the radiance under its own light; the longest bar is {:.2g} "
                           "% of the peak. {}",
                           100 * longest, subject.review.heldOut)) +
           barFigure(
               bars, longest,
               {{kShadowColour, "not seen: prediction"}, {kSeenColour, "seen: fit"}, {kSaturatedColour, "left out"}});
}

} // namespace nacre
