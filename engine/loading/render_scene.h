#pragma once
#include "engine/gpu/context.h"
#include "engine/loading/render_arguments.h"
#include "engine/scene/scene.h"

namespace nacre {

// Throws Error (usage) where options contradict each other or are not understood; before anything is read.
void checkSceneArguments(const RenderArguments& arguments);

// The direction towards the viewer; it has to see the front of something.
glm::vec3 viewFromArguments(const RenderArguments& arguments);

// The surface, or its material on other normals, fitted into --size; with the captured lights of the measured one.
Surface surfaceFromArguments(const RenderArguments& arguments, const Context& context);

// The same with the lights and the view. Throws Error (usage) where the residual layer by itself is asked for and there
// is none; says on stderr, unless quiet, where it is left out or fades out.
Scene sceneFromArguments(const RenderArguments& arguments, const Context& context);

// Where a table was not measured it answers with what is nearest: said on stderr, not refused.
void noteUnmeasured(const Scene& scene);

} // namespace nacre
