#pragma once
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace nacre {

// Whole pixels, y down, without those of the end.
struct PixelBox {
    glm::ivec2 low{0, 0}, high{0, 0};
    bool isEmpty() const { return low.x >= high.x || low.y >= high.y; }
    bool operator==(const PixelBox&) const = default;
};
PixelBox overlap(const PixelBox& a, const PixelBox& b);

// Where a window's picture differs from the one before, tile by tile: by what is drawn over each, in which order.
class ChangedTiles {
public:
    static constexpr int kSide = 32; // pixels

    // A picture of so many pixels; all of it differs where the last had another size.
    void begin(const glm::ivec2& size);
    // Something is drawn that reaches no farther than `box`, and that has another `look` where it looks otherwise.
    void add(const PixelBox& box, uint64_t look);
    // The last is no longer at hand.
    void forget() { before_.clear(); }
    // Ends it: boxes that hold all that differs, and do not overlap.
    std::vector<PixelBox> changed();

private:
    std::vector<PixelBox> changedOfRow(int row) const;

    glm::ivec2 size_{0, 0}, tiles_{0, 0};
    std::vector<uint64_t> now_, before_; // of each tile; before_ is empty where all differs
};

} // namespace nacre
