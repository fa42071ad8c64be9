#pragma once
#include <filesystem>

#include "app/materials/render_output.h"
#include "app/materials/transfer_sources.h"

namespace nacre {

// One picture or sequence that was drawn.
struct TransferPicture {
    std::string rig, row, target;
    double unmeasured = 0; // share of the lit pixels that ask for directions nobody measured
    double seconds = 0;    // until the first picture was there, a new material's ball sizes included; coverage apart
};

// RIG_MATERIAL_on_TARGET.png (with frames numbered, and the same as .webp), RIG_MATERIAL_ball.png, and sheet_RIG.png
// with all of a rig: materials down, the ball and the targets across; sheet.png with all of several rigs. `folder`
// exists.
std::vector<TransferPicture> saveTransferPictures(const std::filesystem::path& folder, const TransferSources& sources,
                                                  const RenderOutput& output, const Context& context);

} // namespace nacre
