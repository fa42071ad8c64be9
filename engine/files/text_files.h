#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

// In UTF-8, from UTF-8, UTF-16 (by its byte order mark, or a 0 in its first letter), or Windows-1252 where it is
// neither. The lines of a text file without line ends and the white space around them; blank lines are left out.
std::vector<std::string> loadTextLines(const std::filesystem::path& file);

std::string lowerCase(std::string_view text);
// Names that a person takes for the same are equal: without case, and whether accents are letters' own (NFC) or come
// behind them (NFD, as macOS writes). UTF-8.
std::string comparable(std::string_view name);
// ".png" of a.PNG, ".nacre" of the folder a.nacre/.
std::string lowerExtension(const std::filesystem::path& file);

// Independent of the locale; NaN and infinity are no numbers here.
std::optional<double> parseNumber(std::string_view token);

// The last numbers of a line, at most as many as asked for, in their order, and what stands before them. White space,
// semicolons and commas part numbers; a comma between digits is a decimal comma where the numbers are parted otherwise
// as well ("0,5 1,5" and "0,5;1,5" are two numbers, "0,5,1" three). `numbers` is shorter where a token is none.
struct NumbersAtEnd {
    std::vector<double> numbers;
    std::string_view rest;
};
NumbersAtEnd takeNumbersFromEnd(std::string_view line, size_t most);

// Those of a table: without a heading, which is a first line of words, and comments, which begin with #.
std::vector<std::string> loadTableLines(const std::filesystem::path& file);

// Such lines of numbers, all of one length. A first line of one number is the count of
// the lines (or of the columns, where there are three lines), which is checked and left out. Throws Error; the table is
// not empty.
using NumberTable = std::vector<std::vector<double>>;
NumberTable loadNumberTable(const std::filesystem::path& file);

// A count that begins a file. Throws Error where `text` is none.
size_t parseCount(const std::filesystem::path& file, std::string_view text);
// Throws Error where a file announces another count than it lists.
void requireAnnouncedCount(const std::filesystem::path& file, size_t announced, size_t listed);

} // namespace nacre
