#pragma once
#include <optional>

#include "engine/view_state/changed_tiles.h"
#include "engine/viewer/placed_picture.h"
#include "engine/viewer/ui_pass.h"

namespace nacre {

// What a window shows, kept from frame to frame: pictures, and ImGui over them, drawn again where either has changed.
class WindowPicture {
public:
    explicit WindowPicture(const Context& context) : context_(context) {}

    // The frame between ui's last begin() and end() over the pictures, which count as changed unless they are still, on
    // `background` (codes in [0,1]); copied to the swapchain's image, which is then to be presented.
    void record(VkCommandBuffer commands, const Swapchain& swapchain, size_t image,
                std::span<const PlacedPicture> pictures, const glm::vec3& background, UiPass& ui);

    // Textures of still pictures are gone, so that others may have their handles.
    void forget() { tiles_.forget(); }

private:
    // In what use the picture is.
    ImageUse follow(const Swapchain& swapchain);

    const Context& context_;
    std::optional<Texture> picture_; // in kCopiedFrom, once it has been drawn
    ChangedTiles tiles_;
    uint64_t frames_ = 0;
};

} // namespace nacre
