#pragma once
#include "engine/page/page.h"

namespace nacre {

// dB of a page's pictures against the surface's own, both from the front under some of its captured lights.
double pageDecibels(const Surface& page, const Surface& own);

// Takes steps of the residual layer until the page has at most `budget` bytes (0: any). Throws Error (usage) where too
// few are left for the rest.
void fitIntoBudget(PageContent& content, size_t budget);

} // namespace nacre
