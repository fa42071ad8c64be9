#include "engine/target/ply_size.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

struct Property {
    size_t bytes = 0;      // of a value
    size_t countBytes = 0; // of a list's length; 0 = no list
};

struct Element {
    std::string name;
    uint64_t count = 0;
    std::vector<Property> properties{};

    bool hasLists() const
    {
        for (const Property& property : properties) {
            if (property.countBytes > 0) {
                return true;
            }
        }
        return false;
    }
    size_t fixedBytes() const
    {
        size_t sum = 0;
        for (const Property& property : properties) {
            sum += property.bytes;
        }
        return sum;
    }
};

struct Header {
    bool text = false;
    bool bigEndian = false;
    std::vector<Element> elements;
};

size_t bytesOfType(const fs::path& file, const std::string& type)
{
    static const std::map<std::string, size_t> kBytes = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                                         {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                                         {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                                         {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = kBytes.find(type);
    if (found == kBytes.end()) {
        throw Error(file, fmt::format("has a property of the type '{}'", type), "a type of the PLY format");
    }
    return found->second;
}

Property propertyOf(const fs::path& file, std::istringstream& words)
{
    std::string type, countType;
    words >> type;
    if (type != "list") {
        return {bytesOfType(file, type), 0};
    }
    words >> countType >> type;
    return {bytesOfType(file, type), bytesOfType(file, countType)};
}

Header readHeader(const fs::path& file, std::ifstream& stream)
{
    Header header;
    std::string line;
    std::getline(stream, line);
    if (line.substr(0, 3) != "ply") {
        throw Error(file, "is no PLY", "a file that begins with 'ply'");
    }
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "end_header") {
            return header;
        }
        if (word == "format") {
            words >> word;
            header.text = word == "ascii";
            header.bigEndian = word == "binary_big_endian";
        } else if (word == "element") {
            Element element;
            words >> element.name >> element.count;
            header.elements.push_back(element);
        } else if (word == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(propertyOf(file, words));
        }
    }
    throw Error(file, "is cut off in its header", "a header that ends with 'end_header'");
}

[[noreturn]] void throwCut(const fs::path& file, const Element& element, uint64_t found)
{
    throw Error(file, fmt::format("is cut off after {} of its {} {} elements", found, element.count, element.name),
                "as many as its header says");
}

// One line an element.
void requireLines(const fs::path& file, const Header& header, std::istream& stream)
{
    std::string line;
    for (const Element& element : header.elements) {
        for (uint64_t i = 0; i < element.count; ++i) {
            do {
                if (!std::getline(stream, line)) {
                    throwCut(file, element, i);
                }
            } while (line.find_first_not_of(" \t\r") == std::string::npos);
        }
    }
}

uint64_t readCount(std::istream& stream, size_t bytes, bool bigEndian)
{
    unsigned char raw[8] = {};
    stream.read(reinterpret_cast<char*>(raw), static_cast<std::streamsize>(bytes));
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i) {
        value = value << 8 | raw[bigEndian ? i : bytes - 1 - i];
    }
    return value;
}

void requireBytes(const fs::path& file, const Header& header, std::istream& stream)
{
    uint64_t left = fs::file_size(file) - static_cast<uint64_t>(stream.tellg());
    for (const Element& element : header.elements) {
        if (!element.hasLists()) {
            const size_t bytes = element.fixedBytes();
            if (bytes > 0 && left / bytes < element.count) {
                throwCut(file, element, left / bytes);
            }
            left -= bytes * element.count;
            stream.seekg(static_cast<std::streamoff>(bytes * element.count), std::ios::cur);
            continue;
        }
        for (uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                const uint64_t count =
                    property.countBytes > 0 ? readCount(stream, property.countBytes, header.bigEndian) : 1;
                const uint64_t bytes = property.countBytes + count * property.bytes;
                if (!stream || bytes > left) {
                    throwCut(file, element, i);
                }
                stream.ignore(static_cast<std::streamsize>(count * property.bytes));
                left -= bytes;
            }
        }
    }
}

} // namespace

void requireWholePly(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const Header header = readHeader(file, stream);
    for (const Element& element : header.elements) {
        if (element.name == "tristrips" && element.count > 0) {
            throw Error(file, "holds triangle strips", "triangles or polygons, as 'element face'");
        }
    }
    if (header.text) {
        requireLines(file, header, stream);
    } else {
        requireBytes(file, header, stream);
    }
}

} // namespace nacre
