#include "engine/materials/brdf_source.h"

#include <fmt/format.h>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/brdf/rgl_brdf.h"
#include "engine/materials/material_specification.h"
#include "engine/surface/surface_material.h"

namespace nacre {

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

BrdfSource loadBrdfSource(const std::string& specification, const std::filesystem::path& fitsFolder)
{
    if (auto found = loadSurfaceMaterial(specification)) {
        return {fmt::format("{} of {}", found->material.name, specification.substr(0, specification.rfind('#'))),
                "table of a surface", std::make_shared<const BrdfTable>(std::move(found->material.table)),
                found->scale == RadianceScale::relative};
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
