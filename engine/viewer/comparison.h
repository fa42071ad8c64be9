#pragma once
#include <optional>
#include <string>

#include "engine/view_state/controls.h"
#include "engine/viewer/view_pictures.h"

namespace nacre {

// A photograph or its difference to the render in the render's place, and figures of both.
class PhotographComparison {
public:
    explicit PhotographComparison(const Context& context) : context_(context) {}

    // Follows what the session asks for; `pictures` are drawn. Null photographs: none are at hand.
    void update(const Session& session, const Photographs* photographs, ViewPictures& pictures);
    const Texture* picture() const { return picture_ ? &*picture_ : nullptr; } // null: the render stays
    const std::string& figures() const { return figures_; }

private:
    const Context& context_;
    std::optional<Texture> picture_;
    std::optional<std::pair<size_t, size_t>> compared_; // its photograph, and the render's number
    Comparison by_ = Comparison::none;
    std::string figures_;
};

} // namespace nacre
