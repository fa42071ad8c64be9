#pragma once
#include <filesystem>

#include "engine/gpu/context.h"
#include "engine/viewer/scene_source.h"

namespace nacre {

// The picture of the state, written as a screenshot is, without a window. Throws Error where what the state names
// cannot be read or shown.
void viewHeadless(const Context& context, ViewState state, const Choices& choices, const SceneSource& source,
                  const std::filesystem::path& output);

} // namespace nacre
