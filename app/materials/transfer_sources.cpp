#include "app/materials/transfer_sources.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/materials/target_source.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/lights/light_rigs.h"
#include "engine/loading/scene_loading.h"
#include "engine/materials/material_specification.h"
#include "engine/target/mesh_file.h"

namespace nacre {

namespace {

// Without the folders, what every name of its kind starts with, and the extension of a file.
std::string essentialPart(const std::string& specification)
{
    constexpr std::array kPrefixes{"merl-abc:", "merl-sgd:", "make:"};
    for (const std::string_view prefix : kPrefixes) {
        if (specification.starts_with(prefix)) {
            return specification.substr(prefix.size());
        }
    }
    const size_t mark = specification.rfind('#');
    std::filesystem::path path = specification.substr(0, mark);
    if (!path.has_filename()) {
        path = path.parent_path(); // a slash at the end
    }
    // Points of numbers are no extensions.
    const bool isFormula = specification.find(':') != std::string::npos && !std::filesystem::exists(path);
    const std::string stem = isFormula ? path.string() : path.stem().string();
    return mark == std::string::npos ? stem : stem + "-" + specification.substr(mark + 1);
}

// What captions and file names call a material, target or rig: the file's stem, the fit's or the material's name; only
// letters, digits, ".", "-" and "_".
std::string shortName(const std::string& specification)
{
    std::string name = essentialPart(specification);
    for (char& c : name) {
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_') {
            c = '-';
        }
    }
    return name.empty() ? "unnamed" : name;
}

// The same of several, told apart by -2, -3, ... where they are alike.
std::vector<std::string> shortNames(const std::vector<std::string>& specifications)
{
    std::map<std::string, int> taken;
    std::vector<std::string> names;
    for (const std::string& specification : specifications) {
        std::string name = shortName(specification);
        const int count = ++taken[name];
        if (count > 1) {
            name += fmt::format("-{}", count);
            ++taken[name];
        }
        names.push_back(name);
    }
    return names;
}

// "0=A,1=B": an index and what belongs to it.
struct IndexedValue {
    size_t index = 0;
    std::string value;
};

bool isDigit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool isFormula(const std::string& text)
{
    return text.find("lambert:") != std::string::npos || text.find("ggx:") != std::string::npos;
}

// Whether `piece` belongs to the value before it, from which a comma parts it.
bool goesOn(const std::string& value, const std::string& piece)
{
    if (std::filesystem::exists(piece)) {
        return false;
    }
    const bool startsAsNumber = !piece.empty() && (isDigit(piece[0]) || piece[0] == '.');
    return (isFormula(value) && startsAsNumber) ||
           (value.starts_with("make:") && piece.find('=') != std::string::npos && !startsAsNumber);
}

bool isIndexed(const std::string& piece)
{
    const size_t equals = piece.find('=');
    return equals != std::string::npos && equals > 0 && std::all_of(piece.begin(), piece.begin() + equals, isDigit);
}

// Up to a comma; to the last one before which a file of that name exists, where names have commas.
size_t pieceLength(const std::string& text, size_t start)
{
    size_t length = std::min(text.find(',', start), text.size()) - start;
    for (size_t end = text.size(); end > start + length; end = text.rfind(',', end - 1)) {
        const std::string name = text.substr(start, end - start);
        if (std::filesystem::exists(name.substr(0, name.find('#')))) {
            return name.size();
        }
    }
    return length;
}

template <typename GoesOn> std::vector<std::string> split(const std::vector<std::string>& texts, const GoesOn& goesOn)
{
    std::vector<std::string> values;
    for (const std::string& text : texts) {
        const size_t own = values.size();
        for (size_t start = 0; start < text.size();) {
            const std::string piece = text.substr(start, pieceLength(text, start));
            start += piece.size() + 1;
            if (values.size() > own && goesOn(values.back(), piece)) {
                values.back() += "," + piece;
            } else {
                values.push_back(piece);
            }
        }
    }
    return values;
}

// The values of an option that takes several, each of which may be a list with commas. Values have commas of their own:
// numbers go on with the formula before them (lambert:0.5,0.2,0.1), key=number with the target (make:cloth,threads=32).
std::vector<std::string> listFromArguments(const std::vector<std::string>& texts)
{
    return split(texts, goesOn);
}

// Numbers from 1 as indices from 0. Throws Error (usage) that names the option.
std::vector<IndexedValue> indexedListFromArguments(const std::string& option, const std::vector<std::string>& texts)
{
    const auto notIndexed = [](const std::string&, const std::string& piece) { return !isIndexed(piece); };
    std::vector<IndexedValue> values;
    for (const std::string& text : split(texts, notIndexed)) {
        const size_t equals = text.find('=');
        IndexedValue value;
        if (!isIndexed(text) || equals + 1 == text.size() ||
            std::from_chars(text.data(), text.data() + equals, value.index).ec != std::errc() || value.index-- == 0) {
            throw Error("", fmt::format("{} {} is not understood", option, text), "1=MATERIAL,2=MATERIAL and so on",
                        Error::kUsage);
        }
        value.value = text.substr(equals + 1);
        values.push_back(std::move(value));
    }
    return values;
}

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

void requireParts(const std::vector<IndexedValue>& labels, const std::vector<TransferTarget>& targets)
{
    const auto most = std::max_element(targets.begin(), targets.end(), [](const auto& a, const auto& b) {
        return a.surface.parts.size() < b.surface.parts.size();
    });
    const std::vector<std::string>& parts = most->surface.parts;
    for (const IndexedValue& label : labels) {
        if (label.index >= parts.size()) {
            throw Error(
                "",
                fmt::format("--labels {}={}: no target has a part {}", label.index + 1, label.value, label.index + 1),
                fmt::format("1 to {} ({}: {})", parts.size(), most->name, fmt::join(parts, ", ")), Error::kUsage);
        }
    }
}

} // namespace

std::vector<TransferRow> loadTransferRows(const TransferArguments& arguments)
{
    std::vector<TransferRow> rows;
    const std::vector<std::string> specifications = listFromArguments(arguments.materials);
    const std::vector<std::string> names = shortNames(specifications);
    for (size_t i = 0; i < specifications.size(); ++i) {
        rows.push_back({names[i], {loadNamed(specifications[i], arguments)}, {}});
    }
    return rows;
}

std::vector<TransferTarget> loadTransferTargets(const TransferArguments& arguments, std::vector<std::string>& warnings)
{
    const std::vector<std::string> sources = listFromArguments(arguments.targets);
    const std::vector<std::string> names = shortNames(sources);
    std::vector<TransferTarget> targets;
    for (size_t i = 0; i < sources.size(); ++i) {
        const bool isDrawn = sources[i].starts_with("make:") || isMeshFile(sources[i]);
        TargetReport report = targetFromSource({.source = sources[i],
                                                .output = {},
                                                .from = {},
                                                .up = {},
                                                .turn = arguments.turn,
                                                .size = isDrawn || arguments.enlarges ? arguments.size : "",
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

TransferSources loadTransferSources(const TransferArguments& arguments)
{
    TransferSources sources;
    sources.rigs = rigsOf(arguments);
    const std::vector<IndexedValue> labels = indexedListFromArguments("--labels", arguments.labels);
    if (arguments.materials.empty() && labels.empty()) {
        throw Error("", "no material is named", "--materials A,B or --labels 1=A,2=B", Error::kUsage);
    }
    sources.materialSeconds = secondsOf([&] {
        sources.rows = loadTransferRows(arguments);
        if (!labels.empty()) {
            sources.rows.push_back(labelledRow(labels, arguments));
        }
    });
    sources.targetSeconds = secondsOf([&] { sources.targets = loadTransferTargets(arguments, sources.warnings); });
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
