#pragma once
#include <filesystem>

#include "engine/gpu/context.h"
#include "engine/viewer/scene_source.h"

namespace nacre {

struct ViewerOptions {
    int width = 1280; // of the window, in the desktop's units
    int height = 720;
    std::filesystem::path screenshots = "."; // folder
    float textScale = 1;
    std::filesystem::path recent{}; // list of RecentFiles; empty: none is kept
};

// Opens a window on the state and returns when it is closed. The context must be one that presents (see
// Window::vulkanExtensions). Throws Error: what the state names cannot be read, the window cannot be opened.
void runViewer(const Context& context, ViewState state, Choices choices, const SceneSource& source,
               const ViewerOptions& options);

} // namespace nacre
