#include "engine/target/mesh_file_end.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/target/ply_size.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// Bytes [from, end) of the file.
std::string bytesFrom(const fs::path& file, uintmax_t from, uintmax_t count)
{
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(count, '\0');
    stream.seekg(static_cast<std::streamoff>(from));
    stream.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<size_t>(stream.gcount()));
    return bytes;
}

std::string lastBytes(const fs::path& file, uintmax_t count)
{
    const uintmax_t size = fs::file_size(file);
    return bytesFrom(file, size - std::min(size, count), std::min(size, count));
}

uint32_t littleEndian(std::string_view bytes)
{
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    }
    return value;
}

std::string_view withoutSpaceAtEnd(std::string_view text)
{
    const size_t last = text.find_last_not_of(" \t\r\n");
    return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

// "f 1/2/3 4/5/6" -> "f #/#/# #/#/#": what lines of one kind have in common.
std::string shapeOfLine(std::string_view line)
{
    std::string shape;
    for (const char c : withoutSpaceAtEnd(line)) {
        const bool number = c != ' ' && c != '\t' && c != '/';
        if (!number) {
            shape += c == '/' ? '/' : ' ';
        } else if (shape.empty() || shape.back() != '#') {
            shape += '#';
        }
    }
    return shape;
}

// A last line without a line break that has fewer or shorter fields than the line before it broke off.
void requireWholeObj(const fs::path& file)
{
    constexpr uintmax_t kEnd = 4096; // bytes that hold the last two lines
    const std::string end = lastBytes(file, kEnd);
    const size_t lastBreak = end.find_last_of('\n');
    if (lastBreak == std::string::npos || lastBreak + 1 == end.size()) {
        return;
    }
    const std::string_view last = std::string_view(end).substr(lastBreak + 1);
    const size_t breakBefore = lastBreak > 0 ? end.find_last_of('\n', lastBreak - 1) : std::string::npos;
    const size_t start = breakBefore == std::string::npos ? 0 : breakBefore + 1;
    const std::string_view before = std::string_view(end).substr(start, lastBreak - start);
    const std::string shape = shapeOfLine(last), expected = shapeOfLine(before);
    if (last[0] == before[0] && shape.size() < expected.size() && expected.starts_with(shape.substr(0, 1))) {
        throw Error(file, fmt::format("is cut off in its last line, '{}'", withoutSpaceAtEnd(last)),
                    fmt::format("a line like the one before it, '{}'", withoutSpaceAtEnd(before)));
    }
}

void requireLength(const fs::path& file, uintmax_t expected, const std::string& why)
{
    const uintmax_t size = fs::file_size(file);
    if (size < expected) {
        throw Error(file, fmt::format("is cut off after {} bytes", size), fmt::format("{} bytes, {}", expected, why));
    }
}

void requireWholeGlb(const fs::path& file)
{
    const std::string header = bytesFrom(file, 0, 12);
    if (header.size() < 12 || header.substr(0, 4) != "glTF") {
        throw Error(file, "is no binary glTF", "a header of 12 bytes that begins with 'glTF'");
    }
    requireLength(file, littleEndian(std::string_view(header).substr(8)), "as its header says");
}

void requireWholeStl(const fs::path& file)
{
    constexpr uintmax_t kHeader = 84, kTriangle = 50; // bytes
    const std::string header = bytesFrom(file, 0, kHeader);
    // Binary files may begin with "solid" too; text has a facet soon after it.
    const bool text = header.starts_with("solid") && bytesFrom(file, 0, 1024).find("facet") != std::string::npos;
    if (text) {
        if (lastBytes(file, 1024).find("endsolid") == std::string::npos) {
            throw Error(file, "is cut off", "text STL that ends with 'endsolid'");
        }
    } else if (header.size() < kHeader) {
        throw Error(file, fmt::format("is cut off after {} bytes", header.size()), "a binary STL header of 84 bytes");
    } else {
        const uint32_t triangles = littleEndian(std::string_view(header).substr(80));
        requireLength(file, kHeader + kTriangle * triangles, fmt::format("{} triangles as its header says", triangles));
    }
}

void requireWholeGltf(const fs::path& file)
{
    if (!withoutSpaceAtEnd(lastBytes(file, 1024)).ends_with('}')) {
        throw Error(file, "is cut off", "JSON that ends with '}'");
    }
}

} // namespace

void requireWholeMeshFile(const fs::path& file)
{
    if (!fs::is_regular_file(file)) {
        throw Error(file, fs::exists(file) ? "is no file" : "does not exist", "a mesh file");
    }
    if (fs::file_size(file) == 0) {
        throw Error(file, "is empty", "a mesh with triangles or polygons");
    }
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".obj") {
        requireWholeObj(file);
    } else if (extension == ".ply") {
        requireWholePly(file);
    } else if (extension == ".glb") {
        requireWholeGlb(file);
    } else if (extension == ".stl") {
        requireWholeStl(file);
    } else {
        requireWholeGltf(file);
    }
}

} // namespace nacre
