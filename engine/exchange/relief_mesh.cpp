#include "engine/exchange/relief_mesh.h"

#include <bit>
#include <cstring>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "engine/files/whole_file.h"
#include "engine/surface/object_places.h"

namespace nacre {

namespace {

static_assert(std::endian::native == std::endian::little, "the PLY says so");

template <class Value> void addBytes(const Value& value, std::string& bytes)
{
    char raw[sizeof(Value)];
    std::memcpy(raw, &value, sizeof(Value));
    bytes.append(raw, sizeof(Value));
}

} // namespace

PictureMetres::PictureMetres(const NormalMap& normals, const Image& height, float width)
    : metres(width / static_cast<float>(normals.width))
{
    const ObjectExtent extent = extentOf(normals);
    across = static_cast<float>(extent.width);
    middle = {extent.middle.x - 0.5 * normals.width, 0.5 * normals.height - extent.middle.y,
              outlineHeight(normals, height)};
}

GltfMesh heightMesh(Surface surface, const Image& height, float width)
{
    surface.height = height;
    surface.places.clear();
    const NormalMap& map = surface.normals;
    const PictureMetres picture(map, height, width);
    const std::vector<glm::vec3> places = pixelPlaces(surface);
    std::vector<int64_t> numbers(places.size(), -1);
    GltfMesh mesh;
    for (size_t i = 0; i < places.size(); ++i) {
        if (map.confidence[i] > 0) {
            numbers[i] = static_cast<int64_t>(mesh.positions.size());
            mesh.positions.push_back(picture.of(places[i]));
            mesh.normals.push_back(map.normals[i]);
            const size_t column = i % map.width, row = i / map.width;
            mesh.uvs.emplace_back((static_cast<float>(column) + 0.5f) / static_cast<float>(map.width),
                                  (static_cast<float>(row) + 0.5f) / static_cast<float>(map.height));
        }
    }
    const auto add = [&](int64_t a, int64_t b, int64_t c) {
        if (a >= 0 && b >= 0 && c >= 0) {
            mesh.indices.insert(mesh.indices.end(),
                                {static_cast<uint32_t>(a), static_cast<uint32_t>(b), static_cast<uint32_t>(c)});
        }
    };
    for (int y = 0; y + 1 < map.height; ++y) {
        for (int x = 0; x + 1 < map.width; ++x) {
            const int64_t a = numbers[map.index(x, y)], b = numbers[map.index(x + 1, y)],
                          c = numbers[map.index(x, y + 1)], d = numbers[map.index(x + 1, y + 1)];
            if (b >= 0 && c >= 0) {
                add(a, c, b);
                add(b, c, d);
            } else {
                add(a, c, d);
                add(a, d, b);
            }
        }
    }
    return mesh;
}

void savePly(const std::filesystem::path& file, const GltfMesh& mesh)
{
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
    for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "s", "t"}) {
        bytes += fmt::format("property float {}\n", property);
    }
    bytes +=
        fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.indices.size() / 3);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        addBytes(mesh.positions[i], bytes);
        addBytes(mesh.normals[i], bytes);
        addBytes(glm::vec2(mesh.uvs[i].x, 1 - mesh.uvs[i].y), bytes);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        addBytes(uint8_t{3}, bytes);
        for (size_t k = i; k < i + 3; ++k) {
            addBytes(mesh.indices[k], bytes);
        }
    }
    writeTextFile(file, bytes);
}

void saveObj(const std::filesystem::path& file, const GltfMesh& mesh)
{
    std::string text;
    const auto to = std::back_inserter(text);
    for (const glm::vec3& p : mesh.positions) {
        fmt::format_to(to, "v {} {} {}\n", p.x, p.y, p.z);
    }
    for (const glm::vec2& uv : mesh.uvs) {
        fmt::format_to(to, "vt {:.6f} {:.6f}\n", uv.x, 1 - uv.y);
    }
    for (const glm::vec3& n : mesh.normals) {
        fmt::format_to(to, "vn {:.6f} {:.6f} {:.6f}\n", n.x, n.y, n.z);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const uint32_t a = mesh.indices[i] + 1, b = mesh.indices[i + 1] + 1, c = mesh.indices[i + 2] + 1;
        fmt::format_to(to, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a, b, c);
    }
    writeTextFile(file, text);
}

} // namespace nacre
