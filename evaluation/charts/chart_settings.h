#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "engine/brdf/compact_brdf.h"
#include "engine/files/measures.h"
#include "engine/scene/ball_size.h"

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

// A path of the renderer: every pixel looks every light up in the table, or all lights in one ball of that size.
struct RenderingSetting {
    bool isBall = false;
    BallSize size; // of every material's ball; 0 texels: as the program measures it, material by material
    bool operator==(const RenderingSetting&) const = default;
};

struct RenderingRow {
    std::string capture;
    RenderingSetting setting;
    size_t lights = 0;
    double steadyMs = 0; // a frame, once everything is on the device
    double movedMs = 0;  // the first frame after every light has moved
    double psnr = 0;     // dB of the picture's codes against codes that nothing has rounded
    bool isDefault = false;
};

struct RenderingChoices {
    std::vector<RenderingSetting> settings{{},
                                           {true, {}},
                                           {true, {32, 64}},
                                           {true, {64, 128}},
                                           {true, {64, 320}},
                                           {true, {128, 512}},
                                           {true, {256, 1024}},
                                           {true, {512, 2048}}};
    std::vector<size_t> lights{1, 8, 64};
    int width = 1280, height = 720; // pixels of the frames
    int repeats = 9;                // at most; their median counts
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
// "direct", "ball 64/320": texels of radiance and as shown; "ball auto".
std::string describe(const RenderingSetting& setting);

} // namespace nacre
