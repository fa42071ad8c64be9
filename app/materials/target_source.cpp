#include "app/materials/target_source.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "assets/targets.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/text_files.h"
#include "engine/gpu/context.h"
#include "engine/gpu/texture.h"
#include "engine/scene/light_source.h"
#include "engine/target/height_map.h"
#include "engine/target/mesh_file.h"
#include "engine/target/mesh_raster.h"
#include "engine/target/normal_map_source.h"
#include "engine/target/relief.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr PictureSize kDefaultSize{1024, 1024};
constexpr const char* kMakePrefix = "make:";
constexpr const char* kSources =
    "a mesh (.obj, .ply, .gltf, .glb, .stl), a normal or height map (.png, .exr, .jpg, .tif, "
    ".tga), NAME.nacre or make:NAME";

PictureSize sizeOf(const TargetCommandArguments& arguments)
{
    return arguments.size.empty() ? kDefaultSize : sizeFromArgument("--size", arguments.size);
}

NormalY normalYOf(const TargetCommandArguments& arguments)
{
    if (!arguments.normalY.empty() && arguments.normalY != "gl" && arguments.normalY != "dx") {
        throw Error("", fmt::format("--normal-y {} is not known", arguments.normalY),
                    "gl (green points up) or dx (down)", Error::kUsage);
    }
    return arguments.normalY == "dx" ? NormalY::dx : NormalY::gl;
}

glm::vec3 directionFrom(const char* option, const std::string& text, const glm::vec3& fallback)
{
    if (text.empty()) {
        return fallback;
    }
    const std::vector<float> numbers = numbersFromText(text);
    const glm::vec3 v = numbers.size() == 3 ? glm::vec3(numbers[0], numbers[1], numbers[2]) : glm::vec3(0);
    if (v == glm::vec3(0)) {
        throw Error("", fmt::format("{} {} is no direction", option, text), "x,y,z, not all 0", Error::kUsage);
    }
    return v;
}

struct Option {
    const char* name;
    bool isGiven;
};

// An option that would do nothing is a mistake.
void refuse(const std::string& kind, std::initializer_list<Option> options)
{
    for (const Option& option : options) {
        if (option.isGiven) {
            throw Error("", fmt::format("{} has nothing to do with {}", option.name, kind), "no such option here",
                        Error::kUsage);
        }
    }
}

void fit(const TargetCommandArguments& arguments, TargetReport& report)
{
    if (!arguments.size.empty()) {
        const PictureSize size = sizeOf(arguments);
        report.surface = fittedSurface(report.surface, size.width, size.height);
    }
}

MeshViewOptions viewOptionsOf(const TargetCommandArguments& arguments)
{
    const PictureSize size = sizeOf(arguments);
    MeshViewOptions options{.width = size.width, .height = size.height};
    options.from = directionFrom("--from", arguments.from, options.from);
    // Seen from above or below, what was farthest away is up.
    const bool vertical = options.from.x == 0 && options.from.z == 0;
    options.up = directionFrom("--up", arguments.up, vertical ? glm::vec3(0, 0, -1) : options.up);
    if (!arguments.turn.empty()) {
        options.turn = turnFromText(arguments.turn);
    }
    return options;
}

std::string describeMesh(const Mesh& mesh)
{
    std::string text = fmt::format("{} triangles, {} vertices, {} part{}", mesh.triangleCount(), mesh.positions.size(),
                                   mesh.parts.size(), mesh.parts.size() == 1 ? "" : "s");
    const auto mapped = std::count_if(mesh.parts.begin(), mesh.parts.end(),
                                      [](const MeshPart& part) { return part.normalMap != nullptr; });
    return text + (mapped > 0 ? fmt::format(", {} with a normal map", mapped) : "") +
           (mesh.normalsWereMade ? "; normals made smooth" : "; normals of the file");
}

void warnOfMesh(const std::string& source, const Mesh& mesh, std::vector<std::string>& warnings)
{
    if (mesh.degenerateTriangles > 0) {
        warnings.push_back(
            fmt::format("{}: {} triangles without an area were left out", source, mesh.degenerateTriangles));
    }
    if (mesh.notFiniteTriangles > 0) {
        warnings.push_back(fmt::format("{}: {} triangles with a vertex that is no number were left out", source,
                                       mesh.notFiniteTriangles));
    }
    if (mesh.parts.size() > Surface::kNoMaterial) {
        warnings.push_back(fmt::format("{}: of {} parts those from {} on share one label", source, mesh.parts.size(),
                                       static_cast<int>(Surface::kNoMaterial)));
    }
}

TargetReport targetOfMesh(const TargetCommandArguments& arguments)
{
    refuse("a mesh", {{"--height-scale", !arguments.heightScale.empty()}});
    const MeshViewOptions options = viewOptionsOf(arguments);
    TargetReport report;
    Stopwatch watch;
    const Context context(arguments.device);
    requirePictureSize(context, options.width, options.height);
    report.stages.push_back({"device", watch.lap()});
    const Mesh mesh = loadMesh(arguments.source, {arguments.normalMap, normalYOf(arguments)});
    report.stages.push_back({"read", watch.lap()});
    report.surface = rasterisedMesh(context, mesh, fittedView(mesh, options));
    report.stages.push_back({"rasterise", watch.lap()});
    report.lines.push_back("mesh         " + describeMesh(mesh));
    warnOfMesh(arguments.source, mesh, report.warnings);
    return report;
}

TargetReport targetOfHeightMap(const TargetCommandArguments& arguments)
{
    refuse("a height map", {{"--normal-y", !arguments.normalY.empty()}});
    std::optional<HeightScale> scale;
    if (!arguments.heightScale.empty()) {
        scale = heightScaleFromArgument(arguments.heightScale);
    }
    TargetReport report;
    Stopwatch watch;
    const HeightMap map = loadHeightMap(arguments.source, scale);
    report.stages.push_back({"read", watch.lap()});
    report.surface = surfaceOfHeight(map.height);
    fit(arguments, report);
    report.stages.push_back({"normals", watch.lap()});
    report.lines.push_back(fmt::format("height map   1 in the file is {:.4g} pixels", map.scale));
    if (map.eightBit) {
        report.warnings.push_back(fmt::format(
            "{}: has 8 bits: its 256 heights show as terraces; 16 bits or floats do not", arguments.source));
    }
    return report;
}

void finish(const TargetCommandArguments& arguments, IntegratedSurface integrated, Stopwatch& watch,
            TargetReport& report)
{
    if (integrated.pieces > 0) {
        report.lines.push_back(fmt::format("integrated   {} piece{} of connected pixels", integrated.pieces,
                                           integrated.pieces == 1 ? "" : "s"));
    }
    report.surface = std::move(integrated.surface);
    fit(arguments, report);
    report.stages.push_back({"integrate", watch.lap()});
}

TargetReport targetOfNormalMap(const TargetCommandArguments& arguments)
{
    TargetReport report;
    Stopwatch watch;
    const NormalMap map = loadNormalMap(arguments.source, normalYOf(arguments));
    report.stages.push_back({"read", watch.lap()});
    const NormalY normalY = normalYOf(arguments);
    const std::string warning = flippedGreenWarning(arguments.source, map, normalY);
    if (!warning.empty()) {
        report.warnings.push_back(warning + "; --normal-y " + (normalY == NormalY::gl ? "dx" : "gl") + " flips it");
    }
    report.stages.push_back({"check", watch.lap()});
    finish(arguments, surfaceOfNormals(map), watch, report);
    return report;
}

TargetReport targetOfSurface(const TargetCommandArguments& arguments)
{
    refuse("a surface",
           {{"--normal-y", !arguments.normalY.empty()}, {"--height-scale", !arguments.heightScale.empty()}});
    TargetReport report;
    Stopwatch watch;
    Surface acquired = loadSurface(arguments.source);
    report.stages.push_back({"read", watch.lap()});
    finish(arguments, surfaceWithoutMaterials(std::move(acquired)), watch, report);
    return report;
}

TargetReport targetOfSpecification(const TargetCommandArguments& arguments)
{
    refuse("a target that is made",
           {{"--normal-y", !arguments.normalY.empty()}, {"--height-scale", !arguments.heightScale.empty()}});
    const PictureSize size = sizeOf(arguments);
    Stopwatch watch;
    TargetReport report;
    report.surface = generatedShape(arguments.source, size, arguments.threads);
    report.stages.push_back({"make", watch.lap()});
    return report;
}

bool isPicture(const fs::path& file)
{
    constexpr std::array kExtensions = {".png", ".exr", ".jpg", ".jpeg", ".tif", ".tiff", ".tga", ".hdr", ".bmp"};
    return std::find(kExtensions.begin(), kExtensions.end(), lowerCase(file.extension().string())) != kExtensions.end();
}

// Of what is no mesh.
TargetReport targetFromTheFront(const TargetCommandArguments& arguments)
{
    if (isGenerated(arguments.source)) {
        return targetOfSpecification(arguments);
    }
    if (!fs::exists(arguments.source)) {
        throw Error(arguments.source, "does not exist", kSources);
    }
    if (fs::is_directory(arguments.source)) {
        return targetOfSurface(arguments);
    }
    if (!isPicture(arguments.source)) {
        throw Error(arguments.source, "is nothing that a target can be made of", kSources);
    }
    const bool isHeight = !arguments.heightScale.empty() || isGrey(loadImage(arguments.source));
    return isHeight ? targetOfHeightMap(arguments) : targetOfNormalMap(arguments);
}

// The same as a relief of its height, turned.
TargetReport targetOfRelief(const TargetCommandArguments& arguments)
{
    TargetCommandArguments front = arguments;
    if (!isGenerated(arguments.source)) {
        front.size.clear(); // pixels that are repeated make stairs of a height
    }
    TargetReport report = targetFromTheFront(front);
    const Stopwatch watch;
    const Mesh relief = reliefMesh(std::make_shared<const Surface>(std::move(report.surface)));
    const NormalMap& picture = relief.front->normals;
    const PictureSize size = arguments.size.empty() ? PictureSize{picture.width, picture.height} : sizeOf(arguments);
    const MeshViewOptions options{.width = size.width, .height = size.height, .turn = turnFromText(arguments.turn)};
    report.surface = rasterisedMesh(Context(arguments.device), relief, fittedView(relief, options));
    report.surface.parts = relief.front->parts;
    report.stages.push_back({"turn", watch.seconds()});
    return report;
}

} // namespace

Surface generatedShape(const std::string& source, const PictureSize& size, int threads)
{
    Target target = makeTarget(source.substr(std::string_view(kMakePrefix).size()), size.width, size.height, threads);
    Surface surface;
    surface.normals = std::move(target.normals);
    surface.height = std::move(target.height);
    surface.labels = std::move(target.labels);
    surface.parts = std::move(target.parts);
    return surface;
}

SceneInputs sceneInputs(const std::filesystem::path& fits)
{
    return {.fits = fits, .makeShape = [](const std::string& source, const PictureSize& size) {
                return generatedShape(source, size, 0);
            }};
}

TargetReport targetFromSource(const TargetCommandArguments& arguments)
{
    normalYOf(arguments);
    if (!isGenerated(arguments.source) && isMeshFile(arguments.source)) {
        return targetOfMesh(arguments);
    }
    refuse("a source that is no mesh", {{"--from", !arguments.from.empty()},
                                        {"--up", !arguments.up.empty()},
                                        {"--normal-map", !arguments.normalMap.empty()}});
    const bool isTurned = !arguments.turn.empty() && turnFromText(arguments.turn) != Turn();
    return isTurned ? targetOfRelief(arguments) : targetFromTheFront(arguments);
}

} // namespace nacre
