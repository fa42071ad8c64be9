#pragma once
#include <string>
#include <vector>

#include "evaluation/charts/chart_settings.h"
#include "evaluation/charts/chart_svg.h"

namespace nacre {

// A chart and the name of its file.
struct NamedChart {
    std::string file;
    Chart chart;
};

// Of every capture, as far as there are rows: normals against time, the BRDF against bytes and
// against baking time, frames against their time.
std::vector<NamedChart> chartsOf(const ChartRows& rows);

// One page that needs no other file and no network: every chart with the table of its settings. `remarks` stand at
// the top.
std::string reportOf(const ChartRows& rows, const std::vector<std::string>& remarks);

} // namespace nacre
