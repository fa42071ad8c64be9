#include "acquisition/chain/material_models.h"

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
    for (BakedMaterial& material : baked) {
        const ModelLadder& ladder = reduced.ladders.emplace_back(
            options.isAsked() ? climbLadder(judgeOf(material, options.threads), options) : ModelLadder());
        reduced.materials.push_back(
            materialOf(std::move(material), ladder.taken ? &ladder.steps[*ladder.taken].model : nullptr));
    }
    return reduced;
}

} // namespace nacre
