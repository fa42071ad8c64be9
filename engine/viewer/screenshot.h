#pragma once
#include <filesystem>

#include "engine/files/image.h"
#include "engine/viewer/view_state.h"

namespace nacre {

// Metadata field of a screenshot that holds its state file's text.
inline constexpr const char* kStateAttribute = "nacre:state";

// Writes the picture with the state in its metadata, and the state beside it as NAME.json. Throws Error.
void saveScreenshot(const std::filesystem::path& file, const Image& picture, const ViewState& state);

// The first of nacre-0001.png, nacre-0002.png, ... of which neither picture nor state is in the folder.
std::filesystem::path nextScreenshot(const std::filesystem::path& folder);

} // namespace nacre
