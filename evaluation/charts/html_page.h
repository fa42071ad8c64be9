#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/markup.h"

namespace nacre {

// Pages that need no other file, no network and no script, and fit a telephone's width.

// To the heading, which stands in the text; both are plain text.
std::string pageHead(const std::string& title, const std::string& heading);
inline constexpr const char* kPageEnd = "</body></html>\n";

// A row of plain texts. `kind`: empty, or a class that the page's style knows: front, default.
std::string tableRow(const std::vector<std::string>& cells, const std::string& kind = "");
// A table that scrolls by itself where the page is narrow. `body`: rows as tableRow makes them.
std::string tableOf(const std::vector<std::string>& heads, const std::string& body);
// Names and values, which wrap where the page is narrow.
std::string listOf(const std::vector<std::pair<std::string, std::string>>& entries);
// What is folded away until it is asked for.
std::string folded(const std::string& summary, const std::string& html);

// A picture's file as text within the page. `kind`: png or jpeg.
std::string dataUri(const std::filesystem::path& file, const std::string& kind);

} // namespace nacre
