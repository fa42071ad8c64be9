#include "engine/materials/material_specification.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/brdf/rgl_brdf.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/materials/merl_file.h"
#include "engine/surface/surface_material.h"

namespace nacre {

namespace {

constexpr const char* kForms = "NAME.nacre[#MATERIAL], lambert:R,G,B, ggx:diffuse=R,G,B;specular=R,G,B;alpha=A, "
                               "merl-abc:NAME, merl-sgd:NAME, merl:FILE.binary, "
                               "rgl:FILE.bsdf, table:FILE.exr, or such a file";

[[noreturn]] void refuse(const std::string& specification, const std::string& wrong, const std::string& expected)
{
    throw Error({}, fmt::format("material \"{}\": {}", specification, wrong), expected, Error::kUsage);
}

std::vector<float> parseNumbers(const std::string& specification, const std::string& text)
{
    std::vector<float> numbers;
    std::istringstream stream(text);
    for (std::string field; std::getline(stream, field, ',');) {
        float number = 0;
        const char* end = field.data() + field.size();
        auto [stop, problem] = std::from_chars(field.data(), end, number);
        if (problem != std::errc() || stop != end) {
            refuse(specification, fmt::format("\"{}\" is no number", field), "numbers separated by commas");
        }
        numbers.push_back(number);
    }
    return numbers;
}

// Reflectances lie in [0,1].
glm::vec3 parseReflectance(const std::string& specification, const std::string& text)
{
    std::vector<float> x = parseNumbers(specification, text);
    if (x.size() != 1 && x.size() != 3) {
        refuse(specification, fmt::format("\"{}\" has {} numbers", text, x.size()), "one or three");
    }
    if (std::any_of(x.begin(), x.end(), [](float r) { return !(r >= 0.0f && r <= 1.0f); })) {
        refuse(specification, fmt::format("\"{}\" is no reflectance", text), "values from 0 to 1");
    }
    return x.size() == 3 ? glm::vec3(x[0], x[1], x[2]) : glm::vec3(x[0]);
}

// Below 0.01 a highlight is narrower than any capture's texels; above 1 the distribution is no longer GGX.
float parseAlpha(const std::string& specification, const std::string& text)
{
    std::vector<float> x = parseNumbers(specification, text);
    if (x.size() != 1 || !(x[0] >= 0.01f && x[0] <= 1.0f)) {
        refuse(specification, fmt::format("alpha \"{}\"", text), "one number from 0.01 to 1");
    }
    return x[0];
}

LambertGgx parseGgx(const std::string& specification, const std::string& text)
{
    LambertGgx model;
    std::istringstream stream(text);
    for (std::string field; std::getline(stream, field, ';');) {
        size_t equals = field.find('=');
        std::string key = field.substr(0, equals);
        std::string value = equals == std::string::npos ? "" : field.substr(equals + 1);
        if (key == "diffuse") {
            model.diffuse = parseReflectance(specification, value);
        } else if (key == "specular") {
            model.specular = parseReflectance(specification, value);
        } else if (key == "alpha") {
            model.alpha = parseAlpha(specification, value);
        } else {
            refuse(specification, fmt::format("knows no \"{}\"", key), "diffuse=, specular= or alpha=");
        }
    }
    return model;
}

// Levenshtein's distance: insertions, deletions and replacements that turn a into b.
size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = std::exchange(row[0], i);
        for (size_t j = 1; j <= b.size(); ++j) {
            size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row[b.size()];
}

// The three names that look most alike; names that contain the word come first.
std::string nearNames(const std::vector<NamedBrdf>& fits, const std::string& name)
{
    constexpr size_t kShown = 3;
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const NamedBrdf& fit : fits) {
        bool contains = fit.name.find(name) != std::string::npos;
        ranked.emplace_back(contains ? 0 : editDistance(name, fit.name), fit.name);
    }
    std::sort(ranked.begin(), ranked.end());
    std::string names;
    for (size_t i = 0; i < std::min(kShown, ranked.size()); ++i) {
        names += (i == 0 ? "" : ", ") + ranked[i].second;
    }
    return names;
}

BrdfModel findFit(const std::string& specification, const std::vector<NamedBrdf>& fits, const std::string& name)
{
    auto found = std::find_if(fits.begin(), fits.end(), [&](const NamedBrdf& fit) { return fit.name == name; });
    if (found == fits.end()) {
        refuse(specification, fmt::format("there is no fit named \"{}\"", name),
               fmt::format("near names are {}", nearNames(fits, name)));
    }
    return found->model;
}

BrdfModel parseFit(const std::string& specification, const std::string& kind, const std::string& name,
                   const std::filesystem::path& fitsFolder)
{
    if (fitsFolder.empty()) {
        refuse(specification, "no folder of published fits is given",
               "the folder of the fits, or the environment variable NACRE_FITS_DIR");
    }
    if (kind == "merl-abc") {
        return findFit(specification, loadAbcFits(fitsFolder / "merl_abc_params.csv"), name);
    }
    return findFit(specification, loadSgdFits(fitsFolder / "merl_sgd_params.csv"), name);
}

// The kind of a measured material that `specification` says or that its file's extension tells; else empty.
std::string kindOfFile(const std::string& specification, const std::string& kind)
{
    constexpr std::pair<const char*, const char*> kKinds[] = {{"merl", ".binary"}, {"rgl", ".bsdf"}, {"table", ".exr"}};
    for (const auto& [name, extension] : kKinds) {
        if (kind == name) {
            return name;
        }
    }
    for (const auto& [name, extension] : kKinds) {
        if (lowerExtension(specification) == extension) {
            return name;
        }
    }
    return "";
}

BrdfModel loadMeasured(const std::string& kind, const std::filesystem::path& file)
{
    if (kind == "rgl") {
        return std::make_shared<const RglBrdf>(file);
    }
    return std::make_shared<const BrdfTable>(kind == "merl" ? loadMerl(file) : loadBrdfTable(file));
}

} // namespace

NamedBrdf parseMaterial(const std::string& specification, const std::filesystem::path& fitsFolder)
{
    if (auto found = loadSurfaceMaterial(specification)) {
        return {specification, std::make_shared<const BrdfTable>(std::move(found->material.table))};
    }
    size_t colon = specification.find(':');
    std::string kind = specification.substr(0, colon);
    std::string rest = colon == std::string::npos ? "" : specification.substr(colon + 1);
    if (kind == "lambert") {
        return {specification, LambertGgx{parseReflectance(specification, rest), glm::vec3(0), 1.0f}};
    }
    if (kind == "ggx") {
        return {specification, parseGgx(specification, rest)};
    }
    if (kind == "merl-abc" || kind == "merl-sgd") {
        return {specification, parseFit(specification, kind, rest, fitsFolder)};
    }
    if (lowerExtension(specification) == ".brdf") {
        refuse(specification, "holds scattered measurements (Cornell) and no BRDF between them",
               "nacre brdf, which examines it, or another material");
    }
    const std::string measured = kindOfFile(specification, kind);
    if (measured.empty()) {
        refuse(specification, fmt::format("knows no model \"{}\"", kind), kForms);
    }
    const std::filesystem::path file = kind == measured ? rest : specification;
    if (file.empty()) {
        refuse(specification, "names no file", kForms);
    }
    return {specification, loadMeasured(measured, file)};
}

Material loadMaterial(const std::string& specification, const std::filesystem::path& fitsFolder, int threads)
{
    if (auto found = loadSurfaceMaterial(specification)) {
        return std::move(found->material);
    }
    const NamedBrdf named = parseMaterial(specification, fitsFolder);
    if (const BrdfTable* table = tableOf(named.model)) {
        return {named.name, *table, {}};
    }
    Material material{named.name, tabulatedBrdf(named.model, kFullTableSize, {kHalfDifference, kHalfPi}, threads), {}};
    // It is known wherever it is asked; texels below the horizon only help to interpolate those above it.
    std::fill(material.table.confidence.begin(), material.table.confidence.end(), 1.0f);
    return material;
}

std::filesystem::path fitsFolderFrom(const std::filesystem::path& option)
{
    if (!option.empty()) {
        return option;
    }
    const char* variable = std::getenv("NACRE_FITS_DIR");
    return variable ? variable : "";
}

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
