#pragma once
#include <filesystem>

#include "acquisition/chain/acquire.h"

namespace nacre {

// verdicts.png: per light a small picture of how each pixel's observation was judged (white used, blue shadow, yellow
// highlight, red saturated), with the photograph's name.
void saveVerdictPictures(const std::filesystem::path& folder, const Capture& capture, const NormalEstimate& estimate);

} // namespace nacre
