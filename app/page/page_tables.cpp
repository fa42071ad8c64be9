#include "app/page/page_tables.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/brdf/model_ladder.h"
#include "engine/page/held_by_page.h"

namespace nacre {
namespace {

// Tables of half floats, no more texels along a side than a page can hold.
bool fitsPage(const LadderStep& step)
{
    const auto* small = std::get_if<SmallTable>(&step.model);
    return small != nullptr && small->format == TexelFormat::rgba16f &&
           std::max({small->table.size.x, small->table.size.y, small->table.size.z}) <= kMostTexelsAlong;
}

std::string sizeText(const BrdfTable& table)
{
    return fmt::format("table {}x{}x{}", table.size.x, table.size.y, table.size.z);
}

} // namespace

PageTable tableForPage(Material material, double toleranceDecibels, int threads)
{
    requireHeld(material); // smaller tables would hide it
    const BrdfTable full = std::move(material.table);
    const BrdfInterpolant own = [&](const glm::vec3& unit) {
        return InterpolatedValue{.value = sampleTable(full, unit).value};
    };
    LadderOptions options;
    options.threads = threads;
    const ModelLadder ladder = climbLadder(ModelJudge(own, full, threads), options);
    const auto taken = std::find_if(ladder.steps.begin(), ladder.steps.end(), [&](const LadderStep& step) {
        return fitsPage(step) && step.psnr >= toleranceDecibels;
    });
    const bool isSmaller = taken != ladder.steps.end();
    material.table = isSmaller ? expandedTable(taken->model, full) : full;
    material.compact.reset();
    const std::string cost = isSmaller ? fmt::format(", {:.1f} dB of its own {}", taken->psnr, sizeText(full)) : "";
    PageTable page{heldByPage(std::move(material)), ""};
    page.description = sizeText(page.material.table) + cost;
    return page;
}

} // namespace nacre
