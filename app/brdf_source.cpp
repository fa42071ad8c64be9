#include "app/brdf_source.h"

#include <fmt/format.h>

#include "engine/scene/brdf_tabulation.h"
#include "engine/scene/error.h"
#include "engine/scene/material_specification.h"
#include "engine/scene/rgl_brdf.h"
#include "engine/scene/surface.h"

namespace nacre {
namespace {

std::string kindOf(const std::string& specification, const BrdfModel& model)
{
    if (const auto* rgl = std::get_if<std::shared_ptr<const RglBrdf>>(&model)) {
        return fmt::format("RGL database, \"{}\"", (*rgl)->description());
    }
    if (!tableOf(model)) {
        return "model";
    }
    const bool isMerl = specification.rfind("merl:", 0) == 0 || specification.ends_with(".binary");
    return isMerl ? "MERL file, folded to a table" : "table";
}

BrdfSource materialOfSurface(const std::string& folder, int index)
{
    Surface surface = loadSurface(folder);
    if (index < 0 || static_cast<size_t>(index) >= surface.materials.size()) {
        throw Error(folder, fmt::format("holds no material {}", index),
                    surface.materials.empty() ? "a surface with a material"
                                              : fmt::format("--index 0 to {}", surface.materials.size() - 1),
                    Error::kUsage);
    }
    Material& material = surface.materials[index];
    return {fmt::format("{} of {}", material.name, folder), "table of a surface",
            std::make_shared<const BrdfTable>(std::move(material.table)), surface.scale == RadianceScale::relative};
}

} // namespace

BrdfSource loadBrdfSource(const std::string& specification, int index, const std::filesystem::path& fitsFolder)
{
    if (std::filesystem::is_directory(specification)) {
        return materialOfSurface(specification, index);
    }
    NamedBrdf named = parseMaterial(specification, fitsFolder);
    return {named.name, kindOf(specification, named.model), std::move(named.model)};
}

BrdfTable tableOfSource(const BrdfSource& source, int threads)
{
    const BrdfTable* table = tableOf(source.model);
    return table ? *table : tabulatedBrdf(source.model, kFullTableSize, {kHalfDifference, kHalfPi}, threads);
}

} // namespace nacre
