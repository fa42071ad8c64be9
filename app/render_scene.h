#pragma once
#include "app/render_arguments.h"
#include "engine/gpu/context.h"
#include "engine/scene/scene.h"

namespace nacre {

// Throws Error (usage) where options contradict each other or are not understood; before anything is read.
void checkSceneArguments(const RenderArguments& arguments);

// The surface, or its material on other normals, fitted into --size; the lights; the view.
Scene sceneFromArguments(const RenderArguments& arguments, const Context& context);

// A table answers with its border's values beyond the directions that it spans: said on stderr, not refused.
void noteLightsBeyondTables(const Scene& scene);

} // namespace nacre
