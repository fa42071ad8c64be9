#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "acquisition/capture/observations.h"
#include "app/commands/commands.h"
#include "app/report/acquisition_summary.h"
#include "app/report/file_info.h"
#include "engine/files/error.h"
#include "engine/gpu/device_info.h"
#include "engine/surface/surface.h"

namespace nacre {

namespace {

void printDevices()
{
    const std::vector<DeviceInfo> devices = listDevices();
    if (devices.empty()) {
        fmt::print("no Vulkan device; install a driver, e.g. mesa-vulkan-drivers\n");
    }
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        fmt::print("device {}     {}\ntype         {}\ndriver       {}\nVulkan       {}\nlimits       {}\n", i,
                   device.name, device.type, device.driver, device.apiVersion, device.limits);
        if (!device.missing.empty()) {
            fmt::print("cannot draw: lacks {}\n", device.missing);
        }
    }
}

void printSurface(const std::filesystem::path& folder)
{
    const Surface surface = loadSurface(folder);
    const std::vector<float>& confidence = surface.normals.confidence;
    const auto withNormal = std::count_if(confidence.begin(), confidence.end(), [](float c) { return c > 0; });
    fmt::print("surface      {}: {}x{}, {} pixels with a normal ({:.1f} %)\nalbedo       {}\nscale        {}\n",
               folder.string(), surface.normals.width, surface.normals.height, withNormal,
               100.0 * static_cast<double>(withNormal) / static_cast<double>(confidence.size()),
               surface.albedo.values.empty() ? "1 everywhere" : "per pixel",
               surface.scale == RadianceScale::absolute ? "absolute (1/sr)" : "relative");
    if (const auto& pixels = surface.pixelsPerMillimetre) {
        fmt::print("size         {:.4g} x {:.4g} mm, {:.4g} pixels a millimetre\n", surface.normals.width / *pixels,
                   surface.normals.height / *pixels, *pixels);
    }
    for (size_t i = 0; i < surface.materials.size(); ++i) {
        const Material& material = surface.materials[i];
        const auto pixels = std::count(surface.labels.begin(), surface.labels.end(), i);
        fmt::print("material {}   {}: {} pixels, table {}\n", i + 1, material.name, pixels, describe(material.table));
    }
    for (size_t i = 0; i < surface.parts.size(); ++i) {
        const auto pixels = std::count(surface.labels.begin(), surface.labels.end(), i);
        fmt::print("part {:<7} {}: {} pixels\n", i + 1, surface.parts[i], pixels);
    }
    if (!surface.height.values.empty()) {
        const auto [lowest, highest] = std::minmax_element(surface.height.values.begin(), surface.height.values.end());
        fmt::print("height       {:.1f} to {:.1f} pixels{}\n", *lowest, *highest,
                   surface.castsShadows ? ", casts shadows" : "");
    }
    if (!surface.residual.empty()) {
        fmt::print("residual     {} components, {:.1f} KiB, trusts the BRDF by {:.0f} %, of {} lights\n",
                   surface.residual.components, static_cast<double>(bytesOf(surface.residual)) / 1024,
                   100 * surface.residual.trust, surface.residual.nodes.size());
    }
    if (surface.lights.empty()) {
        fmt::print("lights       none\n");
        return;
    }
    fmt::print("\n{:>12} {} {}\n", "--light", kLightColumns, " photograph");
    for (size_t i = 0; i < surface.lights.size(); ++i) {
        fmt::print("{:>12} {}  {}\n", fmt::format("captured:{}", i + 1), describe(surface.lights[i].light),
                   surface.lights[i].photograph);
    }
}

std::string describeSphere(const std::optional<SpherePhotographs>& sphere)
{
    return sphere ? fmt::format("{} photographs, {}", sphere->photographs.size(), sphere->source.string()) : "none";
}

void printCapture(const std::filesystem::path& folder, const std::filesystem::path& mask)
{
    CaptureOptions options;
    options.mask = mask;
    const Capture capture = loadCapture(folder, options);
    ObservationReader reader(capture); // to the end, as a picture may be cut off
    for (Observations block; reader.next(block);) {
    }
    fmt::print("{}", describe(capture));
    if (capture.lights.empty()) {
        fmt::print("lights       not given, to be calibrated\n");
    } else {
        fmt::print("lights       {} directions{} from {}\n", capture.lights.size(),
                   capture.irradianceGiven ? " and irradiances" : "", capture.lightsSource);
    }
    fmt::print("mirror       {}\ndiffuse      {}\n", describeSphere(capture.mirrorSphere),
               describeSphere(capture.diffuseSphere));
    if (!capture.truthNormals.empty()) {
        fmt::print("truth        {}\n", capture.truthNormals.string());
    }
}

// Or the folder of a surface.
bool isCapture(const std::filesystem::path& path)
{
    return std::filesystem::is_directory(path) ? !std::filesystem::exists(path / "info.json")
                                               : path.filename() == "capture.json";
}

void runInfo(const std::filesystem::path& path, const std::filesystem::path& mask)
{
    const bool isOfCapture = !path.empty() && isCapture(path) && !std::filesystem::exists(path / "surface.json");
    if (!mask.empty() && !isOfCapture) {
        throw Error(path, "is no folder of photographs, to which --mask belongs", "one", Error::kUsage);
    }
    if (path.empty()) {
        printDevices();
    } else if (!std::filesystem::exists(path)) {
        throw Error(path, "does not exist", "a folder NAME.nacre, a folder of photographs or a file");
    } else if (!isCapture(path)) {
        printFile(path);
    } else if (std::filesystem::exists(path / "surface.json")) {
        printSurface(path);
    } else {
        printCapture(path, mask);
    }
}

} // namespace

void addInfoCommand(CLI::App& app)
{
    auto path = std::make_shared<std::filesystem::path>();
    CLI::App* command = app.add_subcommand("info", "Vulkan devices; contents of a surface, a capture or a file");
    command->add_option(
        "PATH", *path,
        "Folder NAME.nacre, folder of photographs, or a file that Nacre reads or writes (default: Vulkan devices)");
    auto mask = std::make_shared<std::filesystem::path>();
    command->add_option("--mask", *mask, "Picture that is white on the object of the photographs")->option_text("FILE");
    command->footer("Example:\n  nacre info\n  nacre info horse.nacre");
    command->callback([path, mask] { runInfo(*path, *mask); });
}

} // namespace nacre
