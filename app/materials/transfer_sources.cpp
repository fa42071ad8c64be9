#include "app/materials/transfer_sources.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/arguments/list_argument.h"
#include "app/arguments/short_name.h"
#include "app/materials/target_source.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/lights/light_rigs.h"
#include "engine/loading/scene_loading.h"
#include "engine/materials/material_specification.h"

namespace nacre {

namespace {

constexpr const char* kLabelled = "labels"; // the row of --labels

std::vector<LightRig> rigsOf(const TransferArguments& arguments)
{
    std::vector<LightRig> rigs;
    for (const std::string& text : listFromArguments(arguments.rigs)) {
        rigs.push_back(rigFromArgument(text));
    }
    if (rigs.empty()) {
        rigs.push_back(rigFromArgument(rigNames().front()));
    }
    return rigs;
}

Material loadNamed(const std::string& specification, const TransferArguments& arguments)
{
    return loadMaterial(specification, fitsFolderFrom(arguments.fits), arguments.threads);
}

TransferRow labelledRow(const std::vector<IndexedValue>& labels, const TransferArguments& arguments)
{
    TransferRow row{.name = kLabelled, .materials = {}, .ofPart = {}};
    std::vector<std::string> loaded;
    for (const auto& [part, specification] : labels) {
        auto known = std::find(loaded.begin(), loaded.end(), specification);
        if (known == loaded.end()) {
            row.materials.push_back(loadNamed(specification, arguments));
            known = loaded.insert(loaded.end(), specification);
        }
        row.ofPart.resize(std::max(row.ofPart.size(), part + 1), 0);
        row.ofPart[part] = static_cast<size_t>(known - loaded.begin());
    }
    return row;
}

std::vector<TransferRow> rowsOf(const TransferArguments& arguments, const std::vector<IndexedValue>& labels)
{
    std::vector<TransferRow> rows;
    const std::vector<std::string> specifications = listFromArguments(arguments.materials);
    const std::vector<std::string> names = shortNames(specifications);
    for (size_t i = 0; i < specifications.size(); ++i) {
        rows.push_back({names[i], {loadNamed(specifications[i], arguments)}, {}});
    }
    if (!labels.empty()) {
        rows.push_back(labelledRow(labels, arguments));
    }
    return rows;
}

void requireParts(const std::vector<IndexedValue>& labels, const std::vector<TransferTarget>& targets)
{
    const auto most = std::max_element(targets.begin(), targets.end(), [](const auto& a, const auto& b) {
        return a.surface.parts.size() < b.surface.parts.size();
    });
    const std::vector<std::string>& parts = most->surface.parts;
    for (const IndexedValue& label : labels) {
        if (label.index >= parts.size()) {
            throw Error(
                "", fmt::format("--labels {}={}: no target has a part {}", label.index, label.value, label.index),
                fmt::format("0 to {} ({}: {})", parts.size() - 1, most->name, fmt::join(parts, ", ")), Error::kUsage);
        }
    }
}

std::vector<TransferTarget> targetsOf(const TransferArguments& arguments, std::vector<std::string>& warnings)
{
    const std::vector<std::string> sources = listFromArguments(arguments.targets);
    const std::vector<std::string> names = shortNames(sources);
    std::vector<TransferTarget> targets;
    for (size_t i = 0; i < sources.size(); ++i) {
        TargetReport report = targetFromSource({.source = sources[i],
                                                .output = {},
                                                .from = {},
                                                .up = {},
                                                .size = arguments.size,
                                                .normalMap = {},
                                                .normalY = {},
                                                .heightScale = {},
                                                .device = arguments.device,
                                                .threads = arguments.threads});
        warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
        if (arguments.shadows) {
            castShadows(report.surface, sources[i]);
        }
        targets.push_back({names[i], std::move(report.surface)});
    }
    return targets;
}

} // namespace

TransferSources loadTransferSources(const TransferArguments& arguments)
{
    TransferSources sources;
    sources.rigs = rigsOf(arguments);
    const std::vector<IndexedValue> labels = indexedListFromArguments("--labels", arguments.labels);
    if (arguments.materials.empty() && labels.empty()) {
        throw Error("", "no material is named", "--materials A,B or --labels 0=A,1=B", Error::kUsage);
    }
    sources.materialSeconds = secondsOf([&] { sources.rows = rowsOf(arguments, labels); });
    sources.targetSeconds = secondsOf([&] { sources.targets = targetsOf(arguments, sources.warnings); });
    requireParts(labels, sources.targets);
    return sources;
}

Surface dressed(const TransferTarget& target, const TransferRow& row)
{
    Surface surface = transferredSurface(target.surface, row.materials.front());
    surface.materials = row.materials;
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        const uint8_t part = target.surface.labels[i];
        if (surface.labels[i] != Surface::kNoMaterial && part < row.ofPart.size()) {
            surface.labels[i] = static_cast<uint8_t>(row.ofPart[part]);
        }
    }
    return surface;
}

Surface referenceBall(const TransferRow& row, int size)
{
    Surface ball = transferredSurface(sphereNormalMap(size), row.materials.front());
    ball.materials = row.materials;
    for (size_t i = 0; i < ball.labels.size(); ++i) {
        if (ball.labels[i] != Surface::kNoMaterial) {
            ball.labels[i] = static_cast<uint8_t>(i % size * row.materials.size() / size);
        }
    }
    return ball;
}

} // namespace nacre
