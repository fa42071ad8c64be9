#pragma once
#include "acquisition/chain/acquire.h"
#include "evaluation/charts/chart_settings.h"

namespace nacre {

// A capture as far as its samples, from which tables are made again and again: what acquire() does after its normals.
class ChartBaking {
public:
    // All are referred to while this lives.
    ChartBaking(const Capture& capture, const AcquireOptions& options, const Progress& progress);

    // The surface with tables of full precision; `seconds`: from samples to tables, without the albedo factors.
    Surface bake(const BrdfSetting& setting, double& seconds);

private:
    const Capture& capture_;
    const AcquireOptions& options_;
    Segmentation segmentation_;
    StageClock clock_;
    PreparedCapture prepared_;
    NormalsAndSamples found_;
    Surface surface_; // without materials
};

// As a device reads it from texels of that format.
void quantise(Surface& surface, TexelFormat format);

} // namespace nacre
