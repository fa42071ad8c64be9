#pragma once
#include <functional>

#include "acquisition/chain/acquire.h"
#include "evaluation/charts/chart_settings.h"

namespace nacre {

// Every seventh photograph judges and is given to nobody, as `nacre evaluate` has it.
constexpr size_t kChartHeldOutEvery = 7;

struct ChartObserver {
    // Before each setting: what is tried, how many are done and how many there are, of this capture.
    std::function<void(const std::string& setting, size_t done, size_t all)> progress;
    // Asked between settings; what is finished by then is kept.
    std::function<bool()> isStopped;
};

// Throws Error where the capture has too few photographs or lights that cannot be known.
void requireChartable(const Capture& capture);

// How many settings the capture has.
size_t countSettings(const Capture& capture, const ChartChoices& choices);

// Every setting by the program's own chain; adds a row for each. Settings of the BRDF share the normals and the samples
// that the default finds. Reads the whole capture at once for the photographs held out.
void measureSettings(const Capture& capture, const AcquireOptions& options, const ChartChoices& choices,
                     const ChartObserver& observer, ChartRows& rows);

} // namespace nacre
