#include "app/arguments/list_argument.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

bool isDigit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool isFormula(const std::string& text)
{
    return text.find("lambert:") != std::string::npos || text.find("ggx:") != std::string::npos;
}

// Whether `piece` belongs to the value before it, from which a comma parts it.
bool goesOn(const std::string& value, const std::string& piece)
{
    if (std::filesystem::exists(piece)) {
        return false;
    }
    const bool startsAsNumber = !piece.empty() && (isDigit(piece[0]) || piece[0] == '.');
    return (isFormula(value) && startsAsNumber) ||
           (value.starts_with("make:") && piece.find('=') != std::string::npos && !startsAsNumber);
}

bool isIndexed(const std::string& piece)
{
    const size_t equals = piece.find('=');
    return equals != std::string::npos && equals > 0 && std::all_of(piece.begin(), piece.begin() + equals, isDigit);
}

template <typename GoesOn> std::vector<std::string> split(const std::vector<std::string>& texts, const GoesOn& goesOn)
{
    std::vector<std::string> values;
    for (const std::string& text : texts) {
        std::istringstream stream(text);
        bool isFirst = true;
        for (std::string piece; std::getline(stream, piece, ','); isFirst = false) {
            if (!isFirst && goesOn(values.back(), piece)) {
                values.back() += "," + piece;
            } else {
                values.push_back(piece);
            }
        }
    }
    return values;
}

} // namespace

std::vector<std::string> listFromArguments(const std::vector<std::string>& texts)
{
    return split(texts, goesOn);
}

std::vector<IndexedValue> indexedListFromArguments(const std::string& option, const std::vector<std::string>& texts)
{
    const auto notIndexed = [](const std::string&, const std::string& piece) { return !isIndexed(piece); };
    std::vector<IndexedValue> values;
    for (const std::string& text : split(texts, notIndexed)) {
        const size_t equals = text.find('=');
        IndexedValue value;
        if (!isIndexed(text) || equals + 1 == text.size() ||
            std::from_chars(text.data(), text.data() + equals, value.index).ec != std::errc()) {
            throw Error("", fmt::format("{} {} is not understood", option, text), "0=MATERIAL,1=MATERIAL and so on",
                        Error::kUsage);
        }
        value.value = text.substr(equals + 1);
        values.push_back(std::move(value));
    }
    return values;
}

} // namespace nacre
