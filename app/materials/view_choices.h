#pragma once
#include "engine/loading/render_arguments.h"
#include "engine/viewer/choices.h"

namespace nacre {

// Paths and files within specifications, so that they mean the same wherever a state file lies.
void makeAbsolute(SceneFile& scene);

// A surface as measured and, of several materials, each alone; on its own shape.
Choices choicesOfSurface(const std::filesystem::path& surface);

// The same with what the state shows and lists beside it.
Choices choicesOf(const ViewState& state);

} // namespace nacre
