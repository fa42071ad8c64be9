#include "app/report/file_info.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "acquisition/capture/picture_files.h"
#include "app/report/acquisition_summary.h"
#include "engine/files/image.h"
#include "engine/files/strict_json.h"
#include "engine/files/text_files.h"
#include "engine/lights/light_files.h"
#include "engine/materials/material_specification.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"
#include "engine/target/mesh_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

void printPtm(const fs::path& file)
{
    const PtmFile ptm = loadPtm(file);
    fmt::print("map          {}: {}, {}x{}\n", file.string(), ptmFormatName(ptm.format), ptm.width, ptm.height);
    constexpr std::array<const char*, PtmFile::kTerms> kNames = {"x^2", "y^2", "xy", "x", "y", "1"};
    for (size_t k = 0; k < PtmFile::kTerms; ++k) {
        fmt::print("{:<12} (code - {}) * {:g}\n", kNames[k], ptm.bias[k], ptm.scale[k]);
    }
}

void printRtiWeb(const fs::path& folder)
{
    const RtiPicture picture = loadRtiWeb(folder);
    fmt::print("map          {}: {}x{}\n", folder.string(), picture.width(), picture.height());
}

void printPicture(const fs::path& file)
{
    const ImageHeader header = readImageHeader(file);
    fmt::print("picture      {}: {}x{}, {} channel{}, {} {}\ncurve        {} ({}{}{})\n", file.string(), header.width,
               header.height, header.channels, header.channels == 1 ? "" : "s", header.format, header.pixelType,
               header.curve.name, header.curveIsDeclared ? "declared" : "assumed",
               header.otherColours.empty() ? "" : "; ", header.otherColours);
    if (const std::string maker = readImageAttribute(file, "Software"); !maker.empty()) {
        fmt::print("written by   {}\n", maker);
    }
}

void printLights(const fs::path& file)
{
    const LightFile lights = loadLightFile(file);
    const bool areNamed = !lights.photographs.empty();
    fmt::print("lights       {}: {} directions{}\n\n{:>5} {}{}\n", file.string(), lights.lights.size(),
               lights.irradianceGiven ? " and irradiances" : "", "light", kLightColumns,
               areNamed ? "  photograph" : "");
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        fmt::print("{:>5} {}{}\n", i + 1, describe(lights.lights[i]), areNamed ? "  " + lights.photographs[i] : "");
    }
}

void printJson(const fs::path& file)
{
    const JsonNode root = JsonNode::load(file);
    const std::string format = root.has("format") ? root.at("format").text() : "";
    if (format == "nacre lights") {
        printLights(file);
    } else {
        fmt::print("JSON         {}: {}\n", file.string(), format.empty() ? "no format named" : format);
    }
}

void printMaterial(const fs::path& file)
{
    const BrdfSource source = loadBrdfSource(file.string(), {});
    fmt::print("material     {}\nkind         {}\n", source.name, source.kind);
}

void printMesh(const fs::path& file)
{
    const Mesh mesh = loadMesh(file);
    fmt::print("mesh         {}: {} triangles, {} vertices, {} part{}\n", file.string(), mesh.triangleCount(),
               mesh.positions.size(), mesh.parts.size(), mesh.parts.size() == 1 ? "" : "s");
}

void printSize(const fs::path& file)
{
    fmt::print("file         {}: {} bytes, which Nacre writes and does not read\n", file.string(), fs::file_size(file));
}

struct Kind {
    const char* extension;
    void (*print)(const fs::path&);
};

constexpr Kind kKinds[] = {{".ptm", printPtm},       {".lp", printLights},       {".txt", printLights},
                           {".json", printJson},     {".binary", printMaterial}, {".bsdf", printMaterial},
                           {".brdf", printMaterial}, {".obj", printMesh},        {".ply", printMesh},
                           {".stl", printMesh},      {".gltf", printMesh},       {".glb", printMesh},
                           {".ktx2", printSize},     {".html", printSize},       {".mtlx", printSize},
                           {".svg", printSize},      {".csv", printSize}};

} // namespace

void printFile(const fs::path& file)
{
    if (fs::is_directory(file)) {
        return printRtiWeb(file);
    }
    if (hasPictureExtension(file)) {
        return printPicture(file);
    }
    for (const Kind& kind : kKinds) {
        if (lowerExtension(file) == kind.extension) {
            return kind.print(file);
        }
    }
    throw Error(file, "is of no kind that is known by its extension",
                "a surface, a capture, a picture, lights, a material, a mesh or a .ptm");
}

} // namespace nacre
