#include "app/page/page_export.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "app/materials/transfer_sources.h"
#include "app/page/page_budget.h"
#include "app/page/page_photographs.h"
#include "app/page/page_tables.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/text_files.h"
#include "engine/page/held_by_page.h"
#include "engine/page/page_shape.h"
#include "engine/scene/reference.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kMostSide = 2048; // pixels of a shape: 32-bit telephones hold the arrays of 4 megapixels
constexpr int kOntoSide = 384;  // pixels of the other shapes
constexpr int kMostPagePhotographs = 24;
constexpr size_t kNoteBytes = 4096; // of what the page says of itself

// Every so many pixels alone, where there are more than a page should have.
Surface downscaled(Surface surface, const std::string& name, int mostSide, std::vector<std::string>& warnings)
{
    if (std::max(surface.normals.width, surface.normals.height) <= mostSide) {
        return surface;
    }
    const double share = double(mostSide) / std::max(surface.normals.width, surface.normals.height);
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(share * pixels))); };
    const int width = side(surface.normals.width), height = side(surface.normals.height);
    warnings.push_back(fmt::format("{} has {}x{} pixels: the page has every {:.2f}th, {}x{}", name,
                                   surface.normals.width, surface.normals.height, 1 / share, width, height));
    return fittedSurface(surface, width, height);
}

std::string textOf(double decibels)
{
    return decibels >= 99 ? "exactly" : fmt::format("to {:.1f} dB", decibels);
}

std::string describeLeftOut(const Surface& page, const Surface& own)
{
    if (page.residual.codes == own.residual.codes) {
        return "";
    }
    return page.residual.empty() ? "the residual layer" : "what is weak in the residual layer";
}

// ---- what the page says of itself

std::string describeLights(const Surface& surface)
{
    float least = 90, most = 0;
    bool areNear = false;
    for (const CapturedLight& captured : surface.lights) {
        const float polar = glm::degrees(std::acos(std::clamp(captured.light.direction.z, -1.0f, 1.0f)));
        least = std::min(least, polar), most = std::max(most, polar);
        areNear = areNear || isNear(captured.light);
    }
    return fmt::format(
        "{} photographs from one place, each under one light, {:.0f} to {:.0f} degrees from the camera{}",
        surface.lights.size(), least, most, areNear ? "; the lights stood near the object" : "");
}

std::string describeLeftOutError(const Surface& surface)
{
    return surface.leftOutDecibels
               ? fmt::format("{:.1f} dB PSNR of photographs that the measurement did not see, mean over them",
                             *surface.leftOutDecibels)
               : "not known for this surface";
}

std::vector<PageNote> notesOf(const Surface& own, const Surface& page, const std::string& left, double decibels)
{
    std::vector<PageNote> notes;
    if (!own.lights.empty()) {
        notes.push_back({"Photographs", describeLights(own)});
    }
    notes.push_back({"Held-out error", describeLeftOutError(own)});
    notes.push_back({"Scale", own.scale == RadianceScale::absolute
                                  ? "absolute: reflectance in 1/sr"
                                  : "relative: reflectance up to one factor for the whole object"});
    notes.push_back({"Pixels", fmt::format("{} x {}", own.normals.width, own.normals.height)});
    if (!page.residual.empty()) {
        notes.push_back(
            {"Residual layer", fmt::format("{} pictures that are added for what the material does not explain "
                                           "(light from the object to itself, faults of normals), near "
                                           "the lights of the photographs (dots on the ball)",
                                           page.residual.components)});
    }
    if (!page.horizon.empty()) {
        notes.push_back(
            {"Cast shadows", fmt::format("by the object's height, from {} directions", page.horizon.azimuths)});
    }
    if (!left.empty()) {
        notes.push_back({"Left out for size", left});
    }
    notes.push_back({"This page", fmt::format("agrees with the full measurement {}", textOf(decibels))});
    notes.push_back({"Made by", "Nacre, image-based measurement of reflectance"});
    return notes;
}

std::string nameOf(const fs::path& folder)
{
    const fs::path path = folder.has_filename() ? folder : folder.parent_path();
    return path.stem().string();
}

TransferArguments transferArgumentsOf(const PageArguments& arguments)
{
    TransferArguments transfer;
    transfer.materials = arguments.materials;
    transfer.targets = arguments.onto;
    transfer.fits = arguments.fits;
    transfer.size = fmt::format("{0}x{0}", kOntoSide);
    transfer.enlarges = false;
    transfer.threads = arguments.threads;
    transfer.shadows = arguments.shadows;
    return transfer;
}

void addShapes(const PageArguments& arguments, std::vector<PageShape> shapes, SurfacePage& page, PageContent& content)
{
    for (TransferTarget& target : loadTransferTargets(transferArgumentsOf(arguments), page.warnings)) {
        shapes.push_back({target.name, std::move(target.surface)});
    }
    for (PageShape& shape : shapes) {
        const auto& confidence = shape.surface.normals.confidence;
        if (std::none_of(confidence.begin(), confidence.end(), [](float c) { return c > 0; })) {
            throw Error(shape.name, "has no normals", "a shape that is seen");
        }
        content.shapes.push_back(
            {shape.name, heldByPage(downscaled(std::move(shape.surface), shape.name, kOntoSide, page.warnings))});
    }
}

void addMaterials(const PageArguments& arguments, double tolerance, SurfacePage& page, PageContent& content)
{
    const auto held = [&](Material material) {
        PageTable table = tableForPage(std::move(material), tolerance, arguments.threads);
        page.lines.push_back(fmt::format("material     {}: {}", table.material.name, table.description));
        return std::move(table.material);
    };
    for (Material& material : content.object.materials) {
        material = held(std::move(material));
    }
    for (TransferRow& row : loadTransferRows(transferArgumentsOf(arguments))) {
        content.materials.push_back(held(std::move(row.materials.front())));
    }
}

void describeBytes(const PageText& text, std::vector<std::string>& lines)
{
    for (const PageParts::Share& share : text.shares) {
        lines.push_back(fmt::format("{:>9.1f} KiB {}", static_cast<double>(share.bytes) / 1024, share.kind));
    }
}

} // namespace

void PageArguments::addTo(CLI::App& command)
{
    const char* group = "A page for a browser";
    command.add_option("--page", file, "One page for a browser to write")->option_text("OUT.html")->group(group);
    command
        .add_option("--onto", onto,
                    "More shapes of the page, as nacre transfer takes them: make:NAME, mesh, NAME.nacre, ...")
        ->allow_extra_args(false)
        ->group(group);
    command.add_option("--materials", materials, "More materials of the page, as nacre transfer takes them")
        ->allow_extra_args(false)
        ->group(group);
    command.add_option("--photographs", photographs, "Number of photographs to compare with, of --capture")
        ->group(group);
    command.add_option("--capture", capture, "Capture that the surface was measured from")->group(group);
    command
        .add_option("--tolerance", size.tolerance,
                    "Least PSNR of each material's table against its own: the smallest that has it is taken")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--budget-bytes", size.budget,
                    "Most bytes of the page, e.g. 1MiB: less of the residual layer where it is over")
        ->group(group);
}

void PageArguments::check() const
{
    const auto require = [](bool isFine, const std::string& wrong, const char* expected) {
        if (!isFine) {
            throw Error("", wrong, expected, Error::kUsage);
        }
    };
    const bool hasMore =
        !onto.empty() || !materials.empty() || photographs != 0 || !capture.empty() || !size.budget.empty();
    require(!file.empty() || !hasMore, "there is no page that these options could belong to",
            "--page FILE.html with them");
    require(file.empty() || lowerExtension(file) == ".html" || lowerExtension(file) == ".htm",
            fmt::format("--page {} is no such file", file.string()), "NAME.html");
    require(photographs >= 0 && photographs <= kMostPagePhotographs,
            fmt::format("--photographs {} is out of range", photographs), "0 to 24");
    require((photographs > 0) == !capture.empty(), "photographs and their capture go together",
            "--photographs 6 --capture FOLDER, or neither");
    size.options(threads);
}

SurfacePage pageOfSurface(const PageArguments& arguments, const fs::path& folder, Surface surface,
                          std::vector<PageShape> shapes)
{
    if (surface.materials.empty()) {
        throw Error(folder, "is a target without a material", "a surface of nacre acquire to make a page of");
    }
    const LadderOptions size = arguments.size.options(arguments.threads);
    SurfacePage page;
    PageContent content;
    content.title = nameOf(folder);
    if (arguments.photographs > 0) {
        if (std::max(surface.normals.width, surface.normals.height) > kMostSide) {
            throw Error(folder, "is too large to stand beside its photographs", "--size, or no --photographs");
        }
        content.photographs = photographsForPage(arguments.capture, folder, surface, arguments.photographs);
    }
    const Surface own = downscaled(std::move(surface), content.title, kMostSide, page.warnings);
    content.object = own;
    addMaterials(arguments, size.toleranceDecibels, page, content);
    content.object = heldByPage(std::move(content.object));
    addShapes(arguments, std::move(shapes), page, content);
    // The notes, which tell what was left out, are written last.
    fitIntoBudget(content, size.budgetBytes == 0 ? 0 : std::max<size_t>(size.budgetBytes, kNoteBytes + 1) - kNoteBytes);
    const std::string left = describeLeftOut(content.object, own);
    const double decibels = pageDecibels(content.object, own);
    content.notes = notesOf(own, content.object, left, decibels);
    page.text = makePage(content);
    describeBytes(page.text, page.lines);
    page.lines.push_back(fmt::format("agrees with the full measurement {}{}{}", textOf(decibels),
                                     left.empty() ? "" : "; left out for size: ", left));
    return page;
}

} // namespace nacre
