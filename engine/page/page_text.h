#pragma once
#include <string>

namespace nacre {

// A shader of this folder, or a header "shared/NAME.h", as WebGL 2 takes it: GLSL ES 3.00, shared headers in place of
// their include lines, each once.
std::string pageShader(const std::string& name);

// page.html with the pieces that it names in place of {{name}}. They are inserted as they are.
struct PagePieces {
    std::string title, description, parts;
};
std::string filledPage(const PagePieces& pieces);

} // namespace nacre
