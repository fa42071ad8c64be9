#pragma once
#include <string>
#include <vector>

#include "evaluation/stress/stress.h"

namespace nacre {

// A picture of its own (SVG 1.1) of one sweep's rows, normals or BRDFs: error against setting, a curve per method. The
// breaking point has a ring, what the program warned of a white centre, silent failures are red. Refused settings are
// not drawn. Empty where nothing can be.
std::string stressSvg(const std::vector<StressRow>& rows);

struct StressChart {
    std::string file; // a name that suits a file system
    std::string svg;
};
// Of every sweep: normals, then BRDFs, as far as there are rows.
std::vector<StressChart> stressChartsOf(const std::vector<StressRow>& rows);

// One page that needs no other file and no network: counts, breaking points and every chart.
std::string stressPageOf(const std::vector<StressRow>& rows);

} // namespace nacre
