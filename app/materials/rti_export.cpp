#include "app/materials/rti_export.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "app/materials/rti_fits.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_picture.h"
#include "engine/rti/rti_web.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kFewestLights = 18; // twice the terms of the larger basis
constexpr int kMostLights = 4096;

void print(const RtiExport& asked, const std::string& line)
{
    if (!asked.quiet) {
        fmt::print("{}\n", line);
    }
}

uintmax_t bytesIn(const fs::path& folder)
{
    uintmax_t bytes = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        bytes += entry.file_size();
    }
    return bytes;
}

// The largest angle to the view.
double largestPolarRadians(const std::vector<CapturedLight>& lights)
{
    double largest = 0;
    for (const CapturedLight& captured : lights) {
        largest = std::max(largest, std::acos(std::clamp<double>(captured.light.direction.z, -1, 1)));
    }
    return largest;
}

std::string describeLights(const Surface& surface, const RtiFits& fits)
{
    const double captured = largestPolarRadians(surface.lights);
    const auto beyond = std::count_if(fits.lights().begin(), fits.lights().end(),
                                      [&](const glm::vec3& light) { return light.z < std::cos(captured); });
    std::string text = fmt::format("fitted to {} lights over the hemisphere, exposure {:+.2f} stops",
                                   fits.lights().size(), fits.exposureStops());
    if (captured > 0 && beyond > 0) {
        text += fmt::format(
            "; {} of them farther from the view than the captured ones ({:.0f} degrees), where the material is a guess",
            beyond, glm::degrees(captured));
    }
    return text;
}

std::string describeFile(const fs::path& file, const std::string& content, uintmax_t bytes, double psnr)
{
    return fmt::format("{}: {}, {:.2f} MB, {:.2f} dB against the surface under {} other lights", file.string(), content,
                       static_cast<double>(bytes) / 1e6, psnr, rtiCheckLights().size());
}

void exportPtm(const RtiExport& asked, RtiFits& fits)
{
    const PtmFormat format = asked.ptmFormat == "rgb" ? PtmFormat::rgb : PtmFormat::lrgb;
    savePtm(asked.ptm, ptmFromRti(fits.of(RtiBasis::ptm), format));
    if (!asked.quiet) {
        const double psnr = fits.psnrOf(rtiFromPtm(loadPtm(asked.ptm)));
        print(asked, describeFile(asked.ptm, ptmFormatName(format), fs::file_size(asked.ptm), psnr));
    }
}

RtiBasis basisOfWeb(const RtiExport& asked)
{
    return asked.basis == "ptm" ? RtiBasis::ptm : RtiBasis::hsh;
}

void exportWeb(const RtiExport& asked, RtiFits& fits)
{
    const RtiPicture& picture = fits.of(basisOfWeb(asked));
    WholeOutput output(asked.web, asked.force);
    fs::create_directory(output.temporary());
    saveRtiWeb(output.temporary(), picture, fits.lights());
    output.commit();
    if (!asked.quiet) {
        const std::string content = fmt::format("{} in {} pictures", asked.basis, picture.terms.size());
        const double psnr = fits.psnrOf(loadRtiWeb(asked.web));
        print(asked, describeFile(asked.web, content, bytesIn(asked.web), psnr));
    }
}

} // namespace

void RtiExport::check() const
{
    const auto refuse = [](const std::string& wrong, const std::string& expected) {
        throw Error("", wrong, expected, Error::kUsage);
    };
    if (ptmFormat != "lrgb" && ptmFormat != "rgb") {
        refuse(fmt::format("--ptm-format {} is not known", ptmFormat), "lrgb or rgb");
    }
    if (basis != "hsh" && basis != "ptm") {
        refuse(fmt::format("--basis {} is not known", basis), "hsh or ptm");
    }
    if (lights < kFewestLights || lights > kMostLights) {
        refuse(fmt::format("--lights {} is out of range", lights), fmt::format("{} to {}", kFewestLights, kMostLights));
    }
    if (exposure && !std::isfinite(*exposure)) {
        refuse("--exposure is not finite", "a number of stops");
    }
}

void exportRti(const RtiExport& asked, const Surface& surface)
{
    std::vector<RtiBasis> bases;
    if (!asked.ptm.empty()) {
        bases.push_back(RtiBasis::ptm);
    }
    if (!asked.web.empty() && (bases.empty() || bases.front() != basisOfWeb(asked))) {
        bases.push_back(basisOfWeb(asked));
    }
    if (bases.empty()) {
        return;
    }
    RtiFits fits(surface, bases, {asked.lights, asked.exposure, asked.threads});
    print(asked, describeLights(surface, fits));
    if (!asked.ptm.empty()) {
        exportPtm(asked, fits);
    }
    if (!asked.web.empty()) {
        exportWeb(asked, fits);
    }
}

} // namespace nacre
