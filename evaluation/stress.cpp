#include "evaluation/stress.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "acquisition/normals/pixel_sample.h"
#include "engine/scene/error.h"

namespace nacre {

namespace {

NormalMap rowOf(const NormalBlock& block)
{
    NormalMap row(static_cast<int>(block.pixels.size()), 1);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = block.pixels[p];
        row.normals[p] = pixel.confidence > 0 ? pixel.normal : glm::vec3(0);
        row.confidence[p] = pixel.confidence;
    }
    return row;
}

bool hasWarning(const std::vector<std::string>& remarks)
{
    return std::any_of(remarks.begin(), remarks.end(),
                       [](const std::string& remark) { return remark.rfind("warning:", 0) == 0; });
}

void judgeNormals(const NormalMap& normals, const NormalMap& truth, StressRow& row)
{
    const std::vector<uint8_t> everywhere(truth.normals.size(), 1);
    row.error = angularError(normals, truth, everywhere);
    double confidence = 0;
    size_t silent = 0;
    for (size_t p = 0; p < truth.normals.size(); ++p) {
        if (truth.confidence[p] > 0) {
            confidence += normals.confidence[p];
            silent += row.said == Said::nothing && normals.confidence[p] > 0.5f &&
                      degreesBetween(normals.normals[p], truth.normals[p]) > kWrongDegrees;
        }
    }
    const double pixels = std::max(1.0, static_cast<double>(row.error.pixels));
    row.meanConfidence = confidence / pixels;
    row.silentShare = static_cast<double>(silent) / pixels;
}

NormalMap estimate(const PhotographedObject& object, const AcquireOptions& options, Said& said)
{
    requireSpanningLights(object.lights, object.name);
    const PreparedNormals prepared =
        prepareNormals({evenSample(object.seen), object.photographs, object.irradiancesKnown, object.lights}, options);
    said = hasWarning(prepared.report.remarks) ? Said::warning : Said::nothing;
    return rowOf(estimateBlock(prepared.estimator, selectLights(object.seen, prepared.agreeing), prepared.lights));
}

} // namespace

StressRow measureNormals(const PhotographedObject& object, NormalMethod method, const AcquireOptions& options)
{
    StressRow row;
    row.method = nameOf(method);
    AcquireOptions chosen = options;
    chosen.normals.method = method;
    NormalMap normals(object.truth.width, object.truth.height);
    const auto start = std::chrono::steady_clock::now();
    try {
        normals = estimate(object, chosen, row.said);
    } catch (const Error&) {
        row.said = Said::refusal;
    }
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    judgeNormals(normals, object.truth, row);
    return row;
}

std::vector<StressRow> runSweeps(const std::string& capture, const std::vector<Sweep>& sweeps,
                                 const std::vector<NormalMethod>& methods, const AcquireOptions& options,
                                 const Progress& progress)
{
    size_t settings = 0, done = 0;
    for (const Sweep& sweep : sweeps) {
        settings += sweep.settings.size();
    }
    std::vector<StressRow> rows;
    for (const Sweep& sweep : sweeps) {
        for (const Sweep::Setting& setting : sweep.settings) {
            progress(fmt::format("{} {}", sweep.name, setting.value),
                     static_cast<double>(done++) / static_cast<double>(settings));
            const PhotographedObject object = setting.photographed();
            for (const NormalMethod method : methods) {
                StressRow row = measureNormals(object, method, options);
                row.capture = capture;
                row.sweep = sweep.name;
                row.setting = setting.value;
                row.unit = sweep.unit;
                rows.push_back(row);
            }
        }
    }
    return rows;
}

} // namespace nacre
