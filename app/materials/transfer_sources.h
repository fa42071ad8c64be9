#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/loading/scene_loading.h"
#include "engine/surface/surface.h"

namespace nacre {

// What nacre transfer takes, as text.
struct TransferArguments {
    std::vector<std::string> materials;
    std::vector<std::string> targets;
    std::vector<std::string> rigs;
    std::vector<std::string> labels; // INDEX=MATERIAL
    std::filesystem::path fits;
    std::filesystem::path output;
    std::string size = "512x512";
    bool enlarges = true; // pictures and surfaces to that size too, beside what is drawn or made
    std::string motion;
    std::string turn; // of the targets: meshes, and the others as reliefs of their heights
    std::string device;
    int frames = 1;
    int threads = 0;
    bool hatch = false;
    bool shadows = false;
    bool force = false;
    bool quiet = false;
};

// What a row of the sheets is made of: one material everywhere, or one a part.
struct TransferRow {
    std::string name;
    std::vector<Material> materials;
    std::vector<size_t> ofPart; // index into materials a part; parts beyond have the first
};

struct TransferTarget {
    std::string name;
    Surface surface; // without materials
};

struct TransferSources {
    std::vector<TransferRow> rows;
    std::vector<TransferTarget> targets;
    std::vector<LightRig> rigs;
    std::vector<std::string> warnings;             // for stderr
    double materialSeconds = 0, targetSeconds = 0; // of reading
};

// The rows of --materials, and the targets of --onto. Throw Error.
std::vector<TransferRow> loadTransferRows(const TransferArguments& arguments);
std::vector<TransferTarget> loadTransferTargets(const TransferArguments& arguments, std::vector<std::string>& warnings);

// Throws Error about whatever cannot be used, before anything is written.
TransferSources loadTransferSources(const TransferArguments& arguments);

// The target dressed: each part in its material.
Surface dressed(const TransferTarget& target, const TransferRow& row);

// A ball to set beside the targets; of several materials each has a vertical band.
Surface referenceBall(const TransferRow& row, int size);

} // namespace nacre
