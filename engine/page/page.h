#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "engine/page/page_parts.h"
#include "engine/surface/surface.h"

namespace nacre {

// One page for a browser, which needs no other file and no network: a surface, materials and shapes that its reader
// lights. Its script, style and shaders are the files beside this one.

struct PageShape {
    std::string name;
    Surface surface; // without materials
};

// A photograph of one of the surface's captured lights.
struct PagePhotograph {
    size_t light = 0;
    std::string jpeg; // a file's bytes: sRGB codes of the crop (page_shape.h) at the exposure below
    float exposureStops = 0;
};

// What the page says about itself.
struct PageNote {
    std::string heading, text;
};

struct PageContent {
    std::string title;
    Surface object;                  // with materials, as heldByPage has it
    std::vector<Material> materials; // more of them, likewise
    std::vector<PageShape> shapes;   // more of them; a sphere is there in any case
    std::vector<PagePhotograph> photographs;
    std::vector<PageNote> notes;
};

struct PageText {
    std::string html;
    std::vector<PageParts::Share> shares; // of its bytes, the page's own text last
};

PageText makePage(const PageContent& content);

} // namespace nacre
