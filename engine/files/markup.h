#pragma once
#include <string>
#include <string_view>

namespace nacre {

// For XML and HTML, in text and in attributes.
std::string escaped(std::string_view text);

// RFC 4648, section 4.
std::string base64(std::string_view bytes);

} // namespace nacre
