#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "engine/brdf/texel_format.h"
#include "engine/files/measures.h"
#include "evaluation/charts/rendering_chart.h"

namespace nacre {

struct NormalSetting {
    NormalMethod method = NormalMethod::automatic;
    size_t lightsGiven = 0; // 0: all that are not held out
    bool operator==(const NormalSetting&) const = default;
};

struct BrdfSetting {
    InterpolationMethod interpolation = InterpolationMethod::localLinear;
    int k = 25;
    size_t size = 0; // index into chartTableSizes
    TexelFormat format = TexelFormat::rgba32f;
    bool operator==(const BrdfSetting&) const = default;
};

// What to try; each member an axis, all combinations of which are settings.
struct ChartChoices {
    std::vector<NormalMethod> methods{NormalMethod::leastSquares, NormalMethod::threshold, NormalMethod::twoStep,
                                      NormalMethod::ransac,       NormalMethod::consensus, NormalMethod::exemplar,
                                      NormalMethod::automatic};
    std::vector<size_t> lightsGiven{0, 36, 12, 6};
    std::vector<InterpolationMethod> interpolations{InterpolationMethod::localLinear, InterpolationMethod::paper};
    std::vector<int> neighbours{5, 12, 25, 50, 100};
    std::vector<TexelFormat> formats{TexelFormat::rgba32f, TexelFormat::rgba16f, TexelFormat::e5b9g9r9};
    RenderingChoices frames;
    bool normals = true; // whether this part is wanted
    bool brdf = true;
    bool rendering = true;
};

// The size that a table has by default, half of it along thetaD and phiD, and half and quarters.
std::vector<glm::ivec3> chartTableSizes(const glm::ivec3& usual);

// `photographs`: how many there are beside those held out. Counts of lights that are not fewer are left out.
std::vector<NormalSetting> normalSettings(const ChartChoices& choices, size_t photographs);
// Formats change fastest: they need no baking of their own.
std::vector<BrdfSetting> brdfSettings(const ChartChoices& choices);

// What the program does where nobody asks for anything else.
bool isDefault(const NormalSetting& setting);
bool isDefault(const BrdfSetting& setting);

struct NormalRow {
    std::string capture;
    NormalSetting setting;
    size_t photographs = 0; // that were given
    double seconds = 0;     // from observations to normals
    bool hasTruth = false;
    AngularError error;  // where truth is known
    double psnr = 0;     // where it is not: dB of held-out photographs
    std::string refusal; // what the program said in place of a result
};

struct BrdfRow {
    std::string capture;
    BrdfSetting setting;
    glm::ivec3 size{0};
    size_t bytes = 0;   // of all materials' tables, coverage apart
    double seconds = 0; // from samples to tables
    double psnr = 0;    // dB of held-out photographs
};

struct ChartRows {
    std::vector<NormalRow> normals;
    std::vector<BrdfRow> brdf;
    std::vector<RenderingRow> rendering;
};

// "consensus, 12 lights"; "k 25, 90x23x23 RGBA16F": the interpolation is told by the marker.
std::string describe(const NormalRow& row);
std::string describe(const BrdfRow& row);

} // namespace nacre
