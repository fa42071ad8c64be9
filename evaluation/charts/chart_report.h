#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/charts/chart_settings.h"
#include "evaluation/charts/gnuplot.h"

namespace nacre {

// The tables that plots read, in the same folder.
inline constexpr const char* kNormalTable = "normals.csv";
inline constexpr const char* kBrdfTable = "brdf.csv";
inline constexpr const char* kRenderingTable = "rendering.csv";

// Of every capture, as far as there are rows: normals against time, the BRDF against bytes and against baking time,
// frames against their time.
std::vector<Plot> plotsOf(const ChartRows& rows);

// One page that needs no other file and no network: every chart that was drawn in the folder with the table of its
// settings. `remarks` stand at the top.
std::string reportOf(const ChartRows& rows, const std::vector<std::string>& remarks,
                     const std::filesystem::path& folder);

} // namespace nacre
