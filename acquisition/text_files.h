#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

// The lines of a text file without line ends and the white space around them; blank lines are left out.
std::vector<std::string> loadTextLines(const std::filesystem::path& file);

// Independent of the locale; NaN and infinity are no numbers here.
std::optional<double> parseNumber(std::string_view token);

// The last token, cut off `text` together with the white space or commas in front of it.
std::string_view takeLastToken(std::string_view& text);

// Lines of numbers, all of one length. A first line of one number is the count of the lines (or of the columns, where
// there are three lines), which is checked and left out. Throws Error; the table is not empty.
using NumberTable = std::vector<std::vector<double>>;
NumberTable loadNumberTable(const std::filesystem::path& file);

// A count that begins a file. Throws Error where `text` is none.
size_t parseCount(const std::filesystem::path& file, std::string_view text);
// Throws Error where a file announces another count than it lists.
void requireAnnouncedCount(const std::filesystem::path& file, size_t announced, size_t listed);

} // namespace nacre
