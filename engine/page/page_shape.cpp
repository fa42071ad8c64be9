#include "engine/page/page_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "engine/lights/light_plane.h"
#include "engine/page/held_by_page.h"
#include "engine/page/packed_plane.h"
#include "engine/scene/ball_size.h"
#include "engine/scene/coverage.h"
#include "engine/surface/object_places.h"

namespace nacre {
namespace {

constexpr const char* kShapes = "normals";
constexpr const char* kFactors = "albedo factors and labels";
constexpr const char* kMaterials = "materials";

// One shape's pixels as planes of the crop.
class Planes {
public:
    Planes(const NormalMap& normals, PageParts& parts) : parts_(parts), crop_(cropOf(normals))
    {
        for (int y = 0; y < crop_.height; ++y) {
            for (int x = 0; x < crop_.width; ++x) {
                pixels_.push_back(normals.index(crop_.x + x, crop_.y + y));
                mask_.push_back(normals.confidence[pixels_.back()] > 0 ? 1 : 0);
            }
        }
    }

    const PageCrop& crop() const { return crop_; }

    size_t addMask(const std::string& kind) const
    {
        const std::vector<uint8_t> all(mask_.size(), 1);
        return parts_.add(kind, deflatedText(filteredPlane(std::span<const uint8_t>(mask_), crop_.width, all)));
    }

    size_t addBytes(const std::string& kind, std::span<const std::byte> bytes) const
    {
        return parts_.add(kind, deflatedText({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}));
    }

    // `at` answers a pixel's number, uint8_t or uint16_t.
    template <class At> size_t add(const std::string& kind, At&& at) const
    {
        using Number = decltype(at(size_t{0}));
        std::vector<Number> values;
        for (const size_t pixel : pixels_) {
            values.push_back(at(pixel));
        }
        return parts_.add(kind, deflatedText(filteredPlane(std::span<const Number>(values), crop_.width, mask_)));
    }

private:
    PageParts& parts_;
    PageCrop crop_;
    std::vector<size_t> pixels_;
    std::vector<uint8_t> mask_;
};

nlohmann::json arrayOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

nlohmann::json describeFactors(const Surface& surface, const Planes& planes)
{
    const float step = albedoStep(surface);
    nlohmann::json json = {{"step", step}, {"planes", nlohmann::json::array()}};
    for (int c = 0; c < 3; ++c) {
        json["planes"].push_back(
            planes.add(kFactors, [&](size_t pixel) { return albedoCode(surface.albedo.values[3 * pixel + c], step); }));
    }
    return json;
}

nlohmann::json describeResidual(const ResidualLayer& layer, const Planes& planes)
{
    const std::vector<glm::vec2> points = lightPlanePoints(layer.nodes);
    nlohmann::json json = {{"trust", layer.trust},
                           {"low", layer.low},
                           {"high", layer.high},
                           {"spacing", meanSpacing(points)},
                           {"hull", nlohmann::json::array()},
                           {"nodes", nlohmann::json::array()},
                           {"weights", planes.addBytes(kResidualPart, std::as_bytes(std::span(layer.weights)))},
                           {"planes", nlohmann::json::array()}};
    const LightHull hull(points);
    for (const glm::vec2& corner : hull.corners()) {
        json["hull"].push_back({corner.x, corner.y});
    }
    for (const glm::vec3& node : layer.nodes) {
        json["nodes"].push_back(arrayOf(node));
    }
    for (int k = 0; k < layer.components; ++k) {
        const size_t first = k / kComponentsPerTexel * layer.pixelCount();
        json["planes"].push_back(planes.add(kResidualPart, [&](size_t pixel) {
            return layer.codes[(first + pixel) * kComponentsPerTexel + k % kComponentsPerTexel];
        }));
    }
    return json;
}

// The third coordinate is stored, in widths of the object; the others follow from the pixel.
nlohmann::json describePlaces(const Surface& surface, const Planes& planes)
{
    const ObjectExtent extent = extentOf(surface.normals);
    const glm::vec4 viewpoint = viewpointOf(surface, kFrontView);
    nlohmann::json json = {{"middle", {extent.middle.x, extent.middle.y}},
                           {"width", extent.width},
                           {"viewpoint", {viewpoint.x, viewpoint.y, viewpoint.z, viewpoint.w}}};
    if (!surface.height.values.empty()) {
        const HeightCodes codes = heightCodes(surface);
        json["low"] = (codes.low - outlineHeight(surface.normals, surface.height)) / extent.width;
        json["step"] = codes.step / extent.width;
        json["plane"] = planes.add("heights", [&](size_t pixel) { return codes.of(surface.height.values[pixel]); });
    }
    return json;
}

} // namespace

PageCrop cropOf(const NormalMap& normals)
{
    int left = normals.width, top = normals.height, right = 0, bottom = 0;
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            if (normals.confidence[normals.index(x, y)] > 0) {
                left = std::min(left, x), right = std::max(right, x + 1);
                top = std::min(top, y), bottom = std::max(bottom, y + 1);
            }
        }
    }
    if (left >= right) {
        return {0, 0, normals.width, normals.height};
    }
    const int margin = 1 + std::max(right - left, bottom - top) / 50;
    left = std::max(0, left - margin), top = std::max(0, top - margin);
    right = std::min(normals.width, right + margin), bottom = std::min(normals.height, bottom + margin);
    return {left, top, right - left, bottom - top};
}

Image cropped(const Image& picture, const PageCrop& crop)
{
    Image part(crop.width, crop.height, 3);
    for (int y = 0; y < crop.height; ++y) {
        for (int x = 0; x < crop.width; ++x) {
            part.setRgb(x, y, picture.rgb(crop.x + x, crop.y + y));
        }
    }
    return part;
}

nlohmann::json describeShape(const std::string& name, const Surface& surface, const ShapeContent& content,
                             PageParts& parts)
{
    const Planes planes(surface.normals, parts);
    const auto code = [&](size_t pixel) { return normalCode(surface.normals.normals[pixel]); };
    const PageCrop& crop = planes.crop();
    nlohmann::json json = {{"name", name},
                           {"x", crop.x},
                           {"y", crop.y},
                           {"width", crop.width},
                           {"height", crop.height},
                           {"mask", planes.addMask(kShapes)},
                           {"normals",
                            {planes.add(kShapes, [&](size_t pixel) { return code(pixel).x; }),
                             planes.add(kShapes, [&](size_t pixel) { return code(pixel).y; })}}};
    if (content.materials) {
        json["labels"] = planes.add(kFactors, [&](size_t pixel) { return surface.labels[pixel]; });
        if (!surface.albedo.values.empty()) {
            json["albedo"] = describeFactors(surface, planes);
        }
        if (!surface.residual.empty()) {
            json["residual"] = describeResidual(surface.residual, planes);
        }
    }
    if (!surface.horizon.empty()) {
        json["azimuths"] = surface.horizon.azimuths;
        json["whole"] = {surface.normals.width, surface.normals.height};
    }
    if (content.places || !surface.horizon.empty()) {
        json["places"] = describePlaces(surface, planes);
    }
    return json;
}

nlohmann::json describeMaterial(const Material& material, PageParts& parts)
{
    const BrdfTable& table = material.table;
    const bool isTold = knowsCoverage(table);
    const std::vector<uint8_t> all(table.values.size(), 1);
    nlohmann::json planes = nlohmann::json::array();
    for (int c = 0; c < (isTold ? 4 : 3); ++c) {
        std::vector<uint16_t> halves;
        for (size_t i = 0; i < table.values.size(); ++i) {
            halves.push_back(glm::packHalf1x16(c < 3 ? table.values[i][c] : expectedError(table, i)));
        }
        planes.push_back(
            parts.add(kMaterials, deflatedText(filteredPlane(std::span<const uint16_t>(halves), table.size.x, all))));
    }
    return {{"name", material.name},
            {"size", {table.size.x, table.size.y, table.size.z}},
            {"coordinates", table.domain.coordinates},
            {"thetaDMax", table.domain.thetaDMax},
            {"ballSide", measuredMeanBallSide(table)},
            {"planes", planes}};
}

} // namespace nacre
