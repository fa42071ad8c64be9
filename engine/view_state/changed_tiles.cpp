#include "engine/view_state/changed_tiles.h"

#include <algorithm>

#include <glm/common.hpp>

#include "engine/files/hash_random.h"

namespace nacre {

PixelBox overlap(const PixelBox& a, const PixelBox& b)
{
    return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}

void ChangedTiles::begin(const glm::ivec2& size)
{
    if (size != size_) {
        forget();
    }
    size_ = size;
    tiles_ = (size + kSide - 1) / kSide;
    now_.assign(static_cast<size_t>(tiles_.x) * tiles_.y, 0);
}

void ChangedTiles::add(const PixelBox& box, uint64_t look)
{
    const PixelBox seen = overlap(box, {{0, 0}, size_});
    if (seen.isEmpty()) {
        return;
    }
    const glm::ivec2 first = seen.low / kSide, end = (seen.high + kSide - 1) / kSide;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            uint64_t& tile = now_[static_cast<size_t>(y) * tiles_.x + x];
            tile = hashOf(tile ^ look);
        }
    }
}

// Side by side ones in one box.
std::vector<PixelBox> ChangedTiles::changedOfRow(int row) const
{
    std::vector<PixelBox> boxes;
    for (int x = 0; x < tiles_.x; ++x) {
        const size_t i = static_cast<size_t>(row) * tiles_.x + x;
        if (!before_.empty() && now_[i] == before_[i]) {
            continue;
        }
        const PixelBox tile =
            overlap({kSide * glm::ivec2(x, row), kSide * glm::ivec2(x + 1, row + 1)}, {{0, 0}, size_});
        if (!boxes.empty() && boxes.back().high.x == tile.low.x) {
            boxes.back().high.x = tile.high.x;
        } else {
            boxes.push_back(tile);
        }
    }
    return boxes;
}

std::vector<PixelBox> ChangedTiles::changed()
{
    std::vector<PixelBox> boxes;
    for (int row = 0; row < tiles_.y; ++row) {
        for (const PixelBox& box : changedOfRow(row)) {
            const auto above = std::find_if(boxes.begin(), boxes.end(), [&](const PixelBox& other) {
                return other.high.y == box.low.y && other.low.x == box.low.x && other.high.x == box.high.x;
            });
            if (above != boxes.end()) {
                above->high.y = box.high.y;
            } else {
                boxes.push_back(box);
            }
        }
    }
    before_ = now_;
    return boxes;
}

} // namespace nacre
