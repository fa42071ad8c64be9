#include "engine/files/text_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <unicode/normalizer2.h>
#include <unicode/unistr.h>
#include <unicode/ustring.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kWhiteSpace = " \t\r\f\v";
constexpr std::string_view kBlanks = " \t\r\f\v;";
constexpr std::string_view kBlanksAndCommas = " \t\r\f\v;,";
constexpr std::string_view kUtf8ByteOrderMark = "\xef\xbb\xbf";

std::string_view trimmed(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(kWhiteSpace), text.size()));
    return text.substr(0, text.find_last_not_of(kWhiteSpace) + 1); // npos + 1 is 0
}

// The last token, cut off `text` together with the separators in front of it.
std::string_view takeLastToken(std::string_view& text, std::string_view separators)
{
    const std::string_view token = text.substr(text.find_last_of(separators) + 1); // npos + 1 is 0
    text.remove_suffix(token.size());
    text = text.substr(0, text.find_last_not_of(separators) + 1);
    return token;
}

// A decimal comma stands between digits, alone.
std::optional<double> parseCommaNumber(std::string_view token)
{
    while (token.ends_with(',')) { // a separator beside white space
        token.remove_suffix(1);
    }
    std::string text(token);
    const size_t comma = text.find(',');
    if (comma != std::string::npos) {
        const auto isDigit = [&](size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
        if (comma == 0 || !isDigit(comma - 1) || !isDigit(comma + 1) || text.find('.') != std::string::npos) {
            return std::nullopt;
        }
        text[comma] = '.';
    }
    return parseNumber(text);
}

template <class Parse>
NumbersAtEnd numbersAtEnd(std::string_view line, size_t most, std::string_view separators, Parse parse)
{
    NumbersAtEnd found{{}, line};
    found.rest = line.substr(0, line.find_last_not_of(separators) + 1);
    while (!found.rest.empty() && found.numbers.size() < most) {
        std::string_view shorter = found.rest;
        const std::optional<double> number = parse(takeLastToken(shorter, separators));
        if (!number) {
            break;
        }
        found.numbers.push_back(*number);
        found.rest = shorter;
    }
    std::reverse(found.numbers.begin(), found.numbers.end());
    return found;
}

std::vector<double> parseRow(const fs::path& file, std::string_view line)
{
    NumbersAtEnd found = takeNumbersFromEnd(line, std::string_view::npos);
    if (!found.rest.empty()) {
        throw Error(file, fmt::format("\"{}\" is no number", takeLastToken(found.rest, kBlanksAndCommas)),
                    "finite numbers");
    }
    return found.numbers;
}

// Of columns, as spreadsheets write them: no number among its words, which begin with a letter.
bool isHeading(std::string_view line)
{
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    bool startsWord = true;
    for (const char c : line) {
        const bool parts = kBlanksAndCommas.find(c) != std::string_view::npos;
        if (startsWord && !parts && c != '"' && !isLetter(c)) {
            return false;
        }
        startsWord = parts || (startsWord && c == '"');
    }
    return line.find_first_of(kBlanksAndCommas) != std::string_view::npos;
}

void requireEqualRows(const fs::path& file, const NumberTable& rows)
{
    for (size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].size() != rows[0].size()) {
            throw Error(file, fmt::format("row {} has {} numbers, row 1 has {}", i + 1, rows[i].size(), rows[0].size()),
                        "as many numbers in every row");
        }
    }
}

bool isUtf8(std::string_view text)
{
    UErrorCode error = U_ZERO_ERROR;
    int32_t length = 0;
    u_strFromUTF8(nullptr, 0, &length, text.data(), static_cast<int32_t>(text.size()), &error);
    return error != U_INVALID_CHAR_FOUND;
}

std::string inUtf8(std::string text)
{
    const bool isWide = text.size() > 1; // what begins with a letter has a 0 beside it in UTF-16 alone
    const char* encoding = text.starts_with("\xff\xfe") || (isWide && text[1] == 0)   ? "utf-16le"
                           : text.starts_with("\xfe\xff") || (isWide && text[0] == 0) ? "utf-16be"
                           : isUtf8(text)                                             ? nullptr
                                                                                      : "windows-1252";
    if (!encoding) {
        return text;
    }
    const icu::UnicodeString read(text.data(), static_cast<int32_t>(text.size()), encoding);
    std::string result;
    return read.toUTF8String(result);
}

} // namespace

std::vector<std::string> loadTextLines(const fs::path& file)
{
    const std::string text = inUtf8(readTextFile(file));
    std::string_view rest = text;
    if (rest.starts_with(kUtf8ByteOrderMark)) {
        rest.remove_prefix(kUtf8ByteOrderMark.size());
    }
    std::vector<std::string> lines;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (!trimmed(line).empty()) {
            lines.emplace_back(trimmed(line));
        }
    }
    return lines;
}

std::string lowerCase(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

std::string comparable(std::string_view name)
{
    UErrorCode error = U_ZERO_ERROR;
    const icu::Normalizer2* normalizer = icu::Normalizer2::getNFKCCasefoldInstance(error);
    const icu::UnicodeString read = icu::UnicodeString::fromUTF8({name.data(), static_cast<int32_t>(name.size())});
    const icu::UnicodeString same = U_SUCCESS(error) ? normalizer->normalize(read, error) : read;
    std::string text;
    return U_SUCCESS(error) ? same.toUTF8String(text) : lowerCase(name);
}

std::string lowerExtension(const fs::path& file)
{
    return lowerCase((file.has_filename() ? file : file.parent_path()).extension().string());
}

std::optional<double> parseNumber(std::string_view token)
{
    if (token.starts_with('+')) {
        token.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc() || end != token.data() + token.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

NumbersAtEnd takeNumbersFromEnd(std::string_view line, size_t most)
{
    NumbersAtEnd found = numbersAtEnd(line, most, kBlanks, parseCommaNumber);
    if (found.numbers.size() == most || found.rest.empty()) {
        found.rest = found.rest.substr(0, found.rest.find_last_not_of(kBlanksAndCommas) + 1);
        return found;
    }
    return numbersAtEnd(line, most, kBlanksAndCommas, parseNumber);
}

std::vector<std::string> loadTableLines(const fs::path& file)
{
    std::vector<std::string> lines = loadTextLines(file);
    lines.erase(std::remove_if(lines.begin(), lines.end(), [](const auto& line) { return line[0] == '#'; }),
                lines.end());
    if (lines.size() > 1 && isHeading(lines[0])) {
        lines.erase(lines.begin());
    }
    return lines;
}

NumberTable loadNumberTable(const fs::path& file)
{
    const std::vector<std::string> lines = loadTableLines(file);
    NumberTable rows;
    for (const std::string& line : lines) {
        rows.push_back(parseRow(file, line));
    }
    if (rows.size() > 1 && rows[0].size() == 1 && rows[1].size() > 1) {
        const size_t announced = parseCount(file, lines[0]);
        rows.erase(rows.begin());
        const bool columns = rows.size() == 3 && rows[0].size() != 3;
        requireAnnouncedCount(file, announced, columns ? rows[0].size() : rows.size());
    }
    if (rows.empty()) {
        throw Error(file, "is empty", "a table of numbers");
    }
    requireEqualRows(file, rows);
    return rows;
}

size_t parseCount(const fs::path& file, std::string_view text)
{
    size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw Error(file, fmt::format("begins with \"{}\"", text), "the number of lights");
    }
    return count;
}

void requireAnnouncedCount(const fs::path& file, size_t announced, size_t listed)
{
    if (announced != listed) {
        throw Error(file, fmt::format("announces {} lights and lists {}", announced, listed),
                    "as many lights as announced");
    }
}

} // namespace nacre
