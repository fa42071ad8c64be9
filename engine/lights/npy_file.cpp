#include "engine/lights/npy_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kTable = "an array of NumPy in two dimensions, little-endian floats";

// The value behind 'key': in the dictionary that begins the file, up to the comma that ends it.
std::string_view entryOf(std::string_view header, std::string_view key, char end)
{
    const size_t named = header.find(key);
    const size_t first = named == std::string_view::npos ? named : header.find_first_not_of(": ", named + key.size());
    const size_t last = first == std::string_view::npos ? first : header.find(end, first);
    return last == std::string_view::npos ? std::string_view() : header.substr(first, last - first);
}

// Of a damaged header, too.
std::string printable(std::string_view text)
{
    std::string result(text.substr(0, 40));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return result;
}

// "(12, 3" to 12 and 3; empty where it is not so.
std::vector<size_t> shapeOf(std::string_view text)
{
    std::vector<size_t> shape;
    for (size_t at = text.find_first_not_of("( ,"); at != std::string_view::npos;
         at = text.find_first_not_of(" ,", at)) {
        size_t& side = shape.emplace_back();
        const auto [next, problem] = std::from_chars(text.data() + at, text.data() + text.size(), side);
        if (problem != std::errc()) {
            return {};
        }
        at = static_cast<size_t>(next - text.data());
    }
    return shape;
}

struct NpyParts {
    std::string_view header, data;
};

// Magic, version, then the header's length: 2 bytes in version 1, 4 from 2 on.
NpyParts partsOf(const fs::path& file, std::string_view bytes)
{
    constexpr std::string_view kMagic = "\x93NUMPY";
    constexpr size_t kVersion = kMagic.size(), kLength = kVersion + 2;
    const size_t width = bytes.size() > kVersion && bytes[kVersion] > 1 ? 4 : 2;
    if (!bytes.starts_with(kMagic) || bytes.size() < kLength + width) {
        throw Error(file, "does not begin as an array of NumPy", kTable);
    }
    size_t length = 0;
    for (size_t i = width; i-- > 0;) {
        length = length << 8 | static_cast<uint8_t>(bytes[kLength + i]);
    }
    const std::string_view rest = bytes.substr(kLength + width);
    if (length > rest.size()) {
        throw Error(file, "ends inside its header", kTable);
    }
    return {rest.substr(0, length), rest.substr(length)};
}

template <class Value> double valueAt(std::string_view data, size_t index)
{
    Value value;
    std::memcpy(&value, data.data() + index * sizeof value, sizeof value);
    return static_cast<double>(value);
}

} // namespace

NumberTable loadNpyTable(const fs::path& file)
{
    const std::string bytes = readWholeFile(file, kTable);
    const NpyParts parts = partsOf(file, bytes);
    const std::string_view type = entryOf(parts.header, "'descr'", ',');
    const std::string_view order = entryOf(parts.header, "'fortran_order'", ',');
    const std::string_view sides = entryOf(parts.header, "'shape'", ')');
    const std::vector<size_t> shape = shapeOf(sides);
    const size_t size = type == "'<f8'" ? sizeof(double) : type == "'<f4'" ? sizeof(float) : 0;
    if (size == 0 || (order != "False" && order != "True") || shape.size() != 2) {
        throw Error(file,
                    fmt::format("holds {} of shape {}), column by column: {}", printable(type), printable(sides),
                                printable(order)),
                    kTable);
    }
    const size_t rows = shape[0], columns = shape[1], values = parts.data.size() / size;
    if (rows == 0 || columns == 0 || values % columns != 0 || values / columns != rows) {
        throw Error(file, fmt::format("announces {} x {} numbers and holds {}", rows, columns, values), kTable);
    }
    NumberTable table(rows, std::vector<double>(columns));
    for (size_t i = 0; i < values; ++i) {
        const double value = size == sizeof(double) ? valueAt<double>(parts.data, i) : valueAt<float>(parts.data, i);
        if (!std::isfinite(value)) {
            throw Error(file, fmt::format("has {} as its number {}", value, i + 1), "finite numbers");
        }
        if (order == "True") { // column by column
            table[i % rows][i / rows] = value;
        } else {
            table[i / columns][i % columns] = value;
        }
    }
    return table;
}

} // namespace nacre
