#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/charts/gnuplot.h"
#include "evaluation/stress/stress.h"

namespace nacre {

// The table that plots read, in the same folder.
inline constexpr const char* kStressTable = "stress.csv";

// Of every sweep, normals and then BRDFs, as far as there are rows: error against setting, a curve per method. The
// breaking point has a ring, what the program warned of a white centre, silent failures are red. Refused settings are
// not drawn.
std::vector<Plot> stressPlotsOf(const std::vector<StressRow>& rows);

// One page that needs no other file and no network: counts, breaking points and every chart that was drawn in the
// folder. `remark`: stands at the top.
std::string stressPageOf(const std::vector<StressRow>& rows, const std::string& remark,
                         const std::filesystem::path& folder);

} // namespace nacre
