#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/parameter_export.h"
#include "app/materials/rti_export.h"
#include "app/page/page_export.h"
#include "engine/exchange/relief_mesh.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/loading/scene_loading.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/picture_size.h"
#include "engine/scene/reference.h"
#include "engine/scene/scene.h"
#include "engine/surface/surface.h"
#include "shared/glsl.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

struct ExportArguments {
    std::filesystem::path surface;
    std::filesystem::path normals;
    std::filesystem::path albedo;
    std::filesystem::path height;
    std::filesystem::path mesh;
    ParameterExport parameters;
    RtiExport rti;
    std::string size;
    int threads = 0;
    bool shadows = false;
    bool quiet = false;
    bool force = false;
    PageArguments page;
    fs::path fits;

    void addTo(CLI::App& command);
    // Throws usage Errors, and data Errors for outputs that cannot be written.
    void check() const;
    bool asksNothingElse() const
    {
        return !rti.isAsked() && normals.empty() && albedo.empty() && height.empty() && mesh.empty() &&
               page.file.empty();
    }
};

Error usageError(const std::string& wrong, const std::string& expected)
{
    return Error("", wrong, expected, Error::kUsage);
}

void requireExtension(const char* option, const fs::path& file, const std::vector<std::string>& extensions)
{
    if (!file.empty() && std::find(extensions.begin(), extensions.end(), lowerExtension(file)) == extensions.end()) {
        throw usageError(fmt::format("{} {} is no such file", option, file.string()),
                         fmt::format("NAME{}", fmt::join(extensions, " or NAME")));
    }
}

void requireChoices(const ExportArguments& arguments)
{
    requireExtension("--ptm", arguments.rti.ptm, {".ptm"});
    requireExtension("--write-normals", arguments.normals, {".png", ".exr"});
    requireExtension("--albedo", arguments.albedo, {".png", ".exr"});
    requireExtension("--height", arguments.height, {".exr"});
    requireExtension("--mesh", arguments.mesh, {".ply", ".obj", ".glb"});
    arguments.rti.check();
    if (!arguments.size.empty()) {
        sizeFromArgument("--size", arguments.size);
    }
    if (arguments.threads < 0) {
        throw usageError(fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all");
    }
}

void requireOutputs(const ExportArguments& arguments)
{
    const ParameterExport& parameters = arguments.parameters;
    std::vector<fs::path> outputs = {arguments.rti.ptm,    arguments.rti.web, arguments.normals,   arguments.albedo,
                                     arguments.height,     arguments.mesh,    arguments.page.file, parameters.gltf,
                                     parameters.materialX, parameters.balls};
    std::erase_if(outputs, [](const fs::path& output) { return output.empty(); });
    if (outputs.empty()) {
        throw usageError(
            "nothing is asked for",
            "--page, --ptm, --rti-web, --write-normals, --albedo, --height, --mesh, --gltf or --materialx");
    }
    parameters.check();
    for (size_t i = 0; i < outputs.size(); ++i) {
        if (std::find(outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(i), outputs[i]) !=
            outputs.begin() + static_cast<std::ptrdiff_t>(i)) {
            throw usageError(fmt::format("{} is asked for twice", outputs[i].string()), "a name for each output");
        }
        if (outputs[i] != arguments.rti.web) {
            requireFile(outputs[i], arguments.force);
        }
    }
    requireWholeFolder(arguments.rti.web, arguments.force, "info.json");
}

void ExportArguments::addTo(CLI::App& command)
{
    command
        .add_option("SURFACE", surface, "Folder NAME.nacre of nacre acquire; for --gltf and --materialx any material")
        ->option_text("NAME.nacre|MATERIAL")
        ->required();
    command.add_option("--ptm", rti.ptm, "Polynomial texture map to write, FILE.ptm")->option_text("FILE");
    command
        .add_option("--ptm-format", rti.ptmFormat,
                    "Format of the PTM: lrgb (one biquadratic and a colour a pixel) or rgb")
        ->capture_default_str();
    command.add_option("--rti-web", rti.web, "Folder for info.json and plane_N.jpg, for OpenLIME and relight")
        ->option_text("OUT");
    command.add_option("--basis", rti.basis, "Functions of --rti-web: hsh (nine) or ptm (six)")->capture_default_str();
    command.add_option("--write-normals", normals, "Normals to write, .png (16 bits, (n + 1) / 2) or .exr")
        ->option_text("FILE");
    command.add_option("--height", height, "Height to write, .exr: pixels towards the viewer")->option_text("FILE");
    command
        .add_option("--mesh", mesh, "Mesh to write, .ply, .obj or .glb: a vertex a pixel, of --width, with its normal")
        ->option_text("FILE");
    command.add_option("--albedo", albedo, "Colour without shading and gloss to write, .png (16 bits) or .exr")
        ->option_text("FILE");
    command.add_option("--gltf", parameters.gltf, "Surface, or sphere of a material, in glTF's parameters, FILE.glb")
        ->option_text("FILE");
    command.add_option("--materialx", parameters.materialX, "Materials as MaterialX's standard_surface, FILE.mtlx")
        ->option_text("FILE");
    command.add_option("--balls", parameters.balls, "Balls of the materials beside those of the parameters, FILE.png")
        ->option_text("FILE");
    command.add_option("--width", parameters.width, "Width of --gltf and --mesh in metres")->capture_default_str();
    command
        .add_option("--fits", fits, "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)")
        ->option_text("DIR");
    command.add_option("--lights", rti.lights, "Number of virtual lights for the fits of --ptm and --rti-web")
        ->capture_default_str();
    command.add_option("--exposure", rti.exposure,
                       "Exposure of --ptm and --rti-web in stops (default: 99th percentile over all lights at 0.9)");
    command.add_flag("--shadows", shadows,
                     "Cast shadows, from the surface's height; always where it explains the photographs'");
    command.add_option("--size", size, "Size in pixels that the surface is fitted into, WxH (default: its own)");
    command.add_option("--threads", threads, "Number of threads (default: all)");
    command.add_flag("--quiet", quiet, "No summary");
    command.add_flag("--force", force, "Replacement of existing outputs");
    page.addTo(command);
}

void ExportArguments::check() const
{
    requireChoices(*this);
    page.check();
    requireOutputs(*this);
}

// A surface's colour per pixel without its highlights and its shading: the reflectance factor pi a f of the albedo
// factor a and the material's f at CIE's 45:0 geometry, lit at 45 degrees and seen along the normal. It is what the
// diffuse reflectance is where there is no gloss; up to the capture's factor where the scale is relative.
Image exportedAlbedo(const Surface& surface)
{
    const glm::vec3 normal(0, 0, 1), light = glm::normalize(glm::vec3(1, 0, 1));
    std::vector<glm::vec3> reflectances;
    for (const Material& material : surface.materials) {
        reflectances.push_back(kPi * evaluateTable(material.table, normal, light, normal).value);
    }
    Image albedo(surface.normals.width, surface.normals.height, 3);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (surface.labels[i] >= reflectances.size() || surface.normals.confidence[i] <= 0) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const float factor = surface.albedo.values.empty() ? 1 : surface.albedo.values[3 * i + c];
            albedo.values[3 * i + c] = factor * reflectances[surface.labels[i]][c];
        }
    }
    return albedo;
}

// EXR: floats. PNG: 16 bits, linear, divided by a power of two that brings the largest value to at most 1 and is
// written as the text nacre:albedoScale. Answers that power of two, 1 for EXR.
float saveAlbedo(const std::filesystem::path& file, const Image& albedo)
{
    if (lowerExtension(file) == ".exr") {
        saveImage(file, albedo, PixelType::float32);
        return 1;
    }
    const float largest = *std::max_element(albedo.values.begin(), albedo.values.end());
    const float scale = largest > 1 ? std::exp2(std::ceil(std::log2(largest))) : 1;
    Image coded = albedo;
    for (float& value : coded.values) {
        value /= scale;
    }
    saveImage(file, coded, PixelType::uint16, {{"nacre:albedoScale", fmt::format("{}", scale)}});
    return scale;
}

Surface surfaceToExport(const ExportArguments& arguments)
{
    Surface surface = loadSurface(arguments.surface);
    const bool needsMaterial = arguments.rti.isAsked() || !arguments.albedo.empty();
    if (needsMaterial && surface.materials.empty()) {
        throw Error(arguments.surface, "is a target without a material",
                    "a surface of nacre acquire; of a target, --write-normals alone can be exported");
    }
    if (arguments.shadows ||
        surface.castsShadows) { // before pixels are repeated, which would make stairs of the height
        castShadows(surface, arguments.surface);
    }
    if (!arguments.size.empty()) {
        const PictureSize size = sizeFromArgument("--size", arguments.size);
        const NormalMap& own = surface.normals;
        if (!arguments.page.file.empty() && size.width > own.width && size.height > own.height) {
            throw usageError(fmt::format("--size {} is larger than the surface", arguments.size),
                             fmt::format("at most {}x{} for a page", own.width, own.height));
        }
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

void exportMesh(const ExportArguments& arguments, const Surface& surface)
{
    if (arguments.mesh.empty()) {
        return;
    }
    const float width = arguments.parameters.width;
    GltfMesh mesh = heightMesh(surface, exportedHeight(surface, arguments.threads), width);
    if (mesh.indices.empty()) {
        throw Error(arguments.surface, "has no normals side by side", "a surface with pixels");
    }
    const size_t triangles = mesh.indices.size() / 3;
    const std::string extension = lowerExtension(arguments.mesh);
    if (extension == ".glb") {
        GltfMaterial grey{.name = "grey", .baseColor = glm::vec3(0.5f), .metallic = 0};
        saveGlb(arguments.mesh, {arguments.surface.stem().string(), std::move(mesh), std::move(grey)});
    } else {
        (extension == ".ply" ? savePly : saveObj)(arguments.mesh, mesh);
    }
    print(arguments, fmt::format("{}: {} triangles, {} m wide, heights {}", arguments.mesh.string(), triangles, width,
                                 surface.height.values.empty() ? "integrated from the normals" : "the surface's own"));
}

void exportMaps(const ExportArguments& arguments, const Surface& surface)
{
    if (!arguments.normals.empty()) {
        saveNormalMap(arguments.normals, surface.normals);
        print(arguments, fmt::format("{}: normals, x right, y up, z to the camera", arguments.normals.string()));
    }
    if (!arguments.height.empty()) {
        saveImage(arguments.height, exportedHeight(surface, arguments.threads), PixelType::float32);
        print(arguments,
              fmt::format("{}: heights in pixels, {}", arguments.height.string(),
                          surface.height.values.empty() ? "integrated from the normals" : "the surface's own"));
    }
    exportMesh(arguments, surface);
    if (!arguments.albedo.empty()) {
        const float scale = saveAlbedo(arguments.albedo, exportedAlbedo(surface));
        print(arguments,
              fmt::format("{}: reflectance factors at 45:0, linear, {}, {}", arguments.albedo.string(),
                          surface.scale == RadianceScale::absolute ? "absolute" : "up to the capture's one factor",
                          scale == 1 ? std::string("as they are") : fmt::format("divided by {}", scale)));
    }
}

void exportPage(const ExportArguments& arguments, const Surface& surface)
{
    if (arguments.page.file.empty()) {
        return;
    }
    PageArguments page = arguments.page;
    page.fits = arguments.fits;
    page.shadows = arguments.shadows;
    page.threads = arguments.threads;
    const SurfacePage made = pageOfSurface(page, arguments.surface, surface);
    for (const std::string& warning : made.warnings) {
        fmt::print(stderr, "nacre: warning: {}\n", warning);
    }
    writeTextFile(page.file, made.text.html);
    print(arguments,
          fmt::format("{}: {:.2f} MB", page.file.string(), static_cast<double>(made.text.html.size()) / 1e6));
    for (const std::string& line : made.lines) {
        print(arguments, "  " + line);
    }
}

// Of the arguments that both kinds of export share.
ParameterExport parametersOf(const ExportArguments& arguments)
{
    ParameterExport asked = arguments.parameters;
    asked.source = arguments.surface.string();
    asked.fits = fitsFolderFrom(arguments.fits);
    asked.threads = arguments.threads;
    asked.quiet = arguments.quiet;
    return asked;
}

void runExport(ExportArguments& arguments)
{
    arguments.parameters = parametersOf(arguments);
    arguments.rti.threads = arguments.threads;
    arguments.rti.force = arguments.force;
    arguments.rti.quiet = arguments.quiet;
    arguments.check();
    if (arguments.parameters.isAsked()) {
        exportParameters(arguments.parameters);
    }
    if (arguments.asksNothingElse()) {
        return;
    }
    const Surface surface = surfaceToExport(arguments);
    exportMaps(arguments, surface);
    exportRti(arguments.rti, surface);
    exportPage(arguments, surface);
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
