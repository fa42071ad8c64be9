#pragma once
#include "engine/files/image.h"
#include "engine/view_state/choices.h"

namespace nacre {

// With the state in its metadata, and beside it as NAME.json.
void saveScreenshot(const std::filesystem::path& file, const Image& picture, const ViewState& state);

// The first of nacre-0001.png, nacre-0002.png, ... of which neither picture nor state is in the folder.
std::filesystem::path nextScreenshot(const std::filesystem::path& folder);

} // namespace nacre
