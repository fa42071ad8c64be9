#include "acquisition/chain/material_models.h"

#include <algorithm>
#include <limits>

namespace nacre {

namespace {

ModelJudge judgeOf(const BakedMaterial& material, int threads)
{
    const auto scaled = [&](const glm::vec3& unit) {
        InterpolatedValue value = material.interpolant(unit);
        value.value *= material.scale;
        return value;
    };
    return {scaled, material.baked.table, threads};
}

// What the materials take without sharing: a full table where no step is good enough.
SharedStep apart(const std::vector<BakedMaterial>& baked, const std::vector<ModelLadder>& ladders)
{
    SharedStep sum{"each by itself", 0, std::numeric_limits<double>::infinity()};
    for (size_t i = 0; i < baked.size(); ++i) {
        const LadderStep* step = ladders[i].taken ? &ladders[i].steps[*ladders[i].taken] : nullptr;
        sum.bytes += step ? step->bytes : baked[i].baked.table.values.size() * bytesPerTexel(TexelFormat::rgba32f);
        sum.leastPsnr = std::min(sum.leastPsnr, step ? step->psnr : sum.leastPsnr);
    }
    return sum;
}

Material materialOf(BakedMaterial baked, const CompactBrdf* model)
{
    if (!model) {
        return {std::move(baked.name), std::move(baked.baked.table), std::move(baked.baked.coverage), {}};
    }
    return {std::move(baked.name), expandedTable(*model, baked.baked.table), {}, *model};
}

} // namespace

ReducedMaterials reduceMaterials(std::vector<BakedMaterial> baked, const LadderOptions& options)
{
    ReducedMaterials reduced;
    reduced.ladders.resize(baked.size());
    if (options.isAsked()) {
        std::vector<ModelJudge> judges;
        for (size_t i = 0; i < baked.size(); ++i) {
            judges.push_back(judgeOf(baked[i], options.threads));
            reduced.ladders[i] = climbLadder(judges[i], options);
        }
        reduced.shared = climbSharedLadder(judges, apart(baked, reduced.ladders), options);
    }
    for (size_t i = 0; i < baked.size(); ++i) {
        const ModelLadder& ladder = reduced.ladders[i];
        const CompactBrdf* own = ladder.taken ? &ladder.steps[*ladder.taken].model : nullptr;
        const CompactBrdf shared = reduced.shared.taken ? reduced.shared.models[i] : CompactBrdf();
        reduced.materials.push_back(materialOf(std::move(baked[i]), reduced.shared.taken ? &shared : own));
    }
    return reduced;
}

} // namespace nacre
