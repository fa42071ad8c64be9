#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "app/arguments/export_arguments.h"
#include "app/commands/commands.h"
#include "app/materials/export_albedo.h"
#include "app/materials/export_rti.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/loading/scene_loading.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"
#include "engine/scene/picture_size.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

Surface surfaceToExport(const ExportArguments& arguments)
{
    Surface surface = loadSurface(arguments.surface);
    const bool needsMaterial = !arguments.ptm.empty() || !arguments.web.empty() || !arguments.albedo.empty();
    if (needsMaterial && surface.materials.empty()) {
        throw Error(arguments.surface, "is a target without a material",
                    "a surface of nacre acquire; of a target, --write-normals alone can be exported");
    }
    if (arguments.shadows) { // before pixels are repeated, which would make stairs of the height
        castShadows(surface, arguments.surface);
    }
    if (!arguments.size.empty()) {
        const PictureSize size = sizeFromArgument("--size", arguments.size);
        surface = fittedSurface(surface, size.width, size.height);
    }
    return surface;
}

void print(const ExportArguments& arguments, const std::string& line)
{
    if (!arguments.quiet) {
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

void exportPtm(const ExportArguments& arguments, RtiFits& fits)
{
    const PtmFormat format = arguments.ptmFormat == "rgb" ? PtmFormat::rgb : PtmFormat::lrgb;
    savePtm(arguments.ptm, ptmFromRti(fits.of(RtiBasis::ptm), format));
    if (!arguments.quiet) {
        const double psnr = fits.psnrOf(rtiFromPtm(loadPtm(arguments.ptm)));
        print(arguments, describeFile(arguments.ptm, ptmFormatName(format), fs::file_size(arguments.ptm), psnr));
    }
}

RtiBasis basisOfWeb(const ExportArguments& arguments)
{
    return arguments.basis == "ptm" ? RtiBasis::ptm : RtiBasis::hsh;
}

void exportWeb(const ExportArguments& arguments, RtiFits& fits)
{
    const RtiPicture& picture = fits.of(basisOfWeb(arguments));
    WholeOutput output(arguments.web, arguments.force);
    fs::create_directory(output.temporary());
    saveRtiWeb(output.temporary(), picture, fits.lights());
    output.commit();
    if (!arguments.quiet) {
        const std::string content = fmt::format("{} in {} pictures", arguments.basis, picture.terms.size());
        const double psnr = fits.psnrOf(loadRtiWeb(arguments.web));
        print(arguments, describeFile(arguments.web, content, bytesIn(arguments.web), psnr));
    }
}

// Both at once, so that each light's picture is made once.
void exportRti(const ExportArguments& arguments, const Surface& surface)
{
    std::vector<RtiBasis> bases;
    if (!arguments.ptm.empty()) {
        bases.push_back(RtiBasis::ptm);
    }
    if (!arguments.web.empty() && (bases.empty() || bases.front() != basisOfWeb(arguments))) {
        bases.push_back(basisOfWeb(arguments));
    }
    if (bases.empty()) {
        return;
    }
    RtiFits fits(surface, bases, {arguments.lights, arguments.exposure, arguments.threads});
    print(arguments, describeLights(surface, fits));
    if (!arguments.ptm.empty()) {
        exportPtm(arguments, fits);
    }
    if (!arguments.web.empty()) {
        exportWeb(arguments, fits);
    }
}

void exportMaps(const ExportArguments& arguments, const Surface& surface)
{
    if (!arguments.normals.empty()) {
        saveNormalMap(arguments.normals, surface.normals);
        print(arguments, fmt::format("{}: normals, x right, y up, z to the camera", arguments.normals.string()));
    }
    if (!arguments.albedo.empty()) {
        const float scale = saveAlbedo(arguments.albedo, exportedAlbedo(surface));
        print(arguments,
              fmt::format("{}: reflectance factors at 45:0, linear, {}, {}", arguments.albedo.string(),
                          surface.scale == RadianceScale::absolute ? "absolute" : "up to the capture's one factor",
                          scale == 1 ? std::string("as they are") : fmt::format("divided by {}", scale)));
    }
}

void runExport(const ExportArguments& arguments)
{
    arguments.check();
    const Surface surface = surfaceToExport(arguments);
    exportMaps(arguments, surface);
    exportRti(arguments, surface);
}

} // namespace

void addExportCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand("export", "A surface for the viewers and programs of others");
    arguments->addTo(*command);
    command->footer(
        "Example:\n  nacre export horse.nacre --ptm horse.ptm --rti-web horse-web --write-normals horse.png");
    command->callback([arguments] { runExport(*arguments); });
}

} // namespace nacre
