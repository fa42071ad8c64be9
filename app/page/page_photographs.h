#pragma once
#include <filesystem>
#include <vector>

#include "engine/page/page.h"

namespace nacre {

// `count` photographs of the surface's captured lights, well spread, as a page has them. `surface`: as read from
// `folder`. Throws Error: usage where there are fewer, data where the capture is not the surface's.
std::vector<PagePhotograph> photographsForPage(const std::filesystem::path& capture,
                                               const std::filesystem::path& folder, const Surface& surface, int count);

} // namespace nacre
