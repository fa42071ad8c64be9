#include "engine/page/page.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "engine/files/markup.h"
#include "engine/lights/light.h"
#include "engine/page/page_shape.h"
#include "engine/page/page_text.h"
#include "engine/scene/picture_size.h"
#include "engine/scene/reference.h"

namespace nacre {
namespace {

constexpr int kExposedSide = 96;                   // pixels of the pictures by which exposures are chosen
const glm::vec3 kFirstLight(-0.42f, 0.48f, 0.77f); // from the upper left: unit to the third digit
constexpr int kSphereSide = 256;                   // of the sphere that the script makes

// What a light of the reader's own shines with: as strong as the captured ones, in white.
glm::vec3 whiteIrradiance(const Surface& surface)
{
    glm::vec3 sum(0);
    for (const CapturedLight& captured : surface.lights) {
        sum += captured.light.irradiance / static_cast<float>(surface.lights.size());
    }
    const bool isKnown = !surface.lights.empty() && std::min({sum.x, sum.y, sum.z}) > 0;
    return isKnown ? sum : glm::vec3(1);
}

// Under the light that the page opens with.
float stopsOf(const Surface& surface, const glm::vec3& irradiance)
{
    Scene scene;
    scene.surface = fittedSurface(surface, kExposedSide, kExposedSide);
    scene.lights = {{glm::normalize(kFirstLight), irradiance}};
    return automaticExposure(renderReference(scene));
}

std::vector<const Material*> materialsOf(const PageContent& content)
{
    std::vector<const Material*> materials;
    for (const auto* list : {&content.object.materials, &content.materials}) {
        for (const Material& material : *list) {
            materials.push_back(&material);
        }
    }
    return materials;
}

// A row a shape, the object first and the sphere last, a column a material; of the object, first its own materials.
nlohmann::json describeExposures(const PageContent& content, const glm::vec3& irradiance)
{
    const std::vector<const Material*> materials = materialsOf(content);
    const auto rowOf = [&](const Surface& target) {
        nlohmann::json row = nlohmann::json::array();
        for (const Material* material : materials) {
            row.push_back(stopsOf(transferredSurface(target, *material), irradiance));
        }
        return row;
    };
    nlohmann::json rows = {rowOf(content.object)};
    rows[0].insert(rows[0].begin(), stopsOf(content.object, irradiance));
    for (const PageShape& shape : content.shapes) {
        rows.push_back(rowOf(shape.surface));
    }
    Surface sphere;
    sphere.normals = sphereNormalMap(kExposedSide);
    rows.push_back(rowOf(sphere));
    return rows;
}

nlohmann::json describeLights(const Surface& surface)
{
    nlohmann::json lights = nlohmann::json::array();
    for (const CapturedLight& captured : surface.lights) {
        const Light& l = captured.light;
        lights.push_back({{"photograph", captured.photograph},
                          {"direction", {l.direction.x, l.direction.y, l.direction.z}},
                          {"irradiance", {l.irradiance.x, l.irradiance.y, l.irradiance.z}},
                          {"nearness", isNear(l) ? 1 / l.distance : 0.0f}});
    }
    return lights;
}

bool hasNearLights(const Surface& surface)
{
    return std::any_of(surface.lights.begin(), surface.lights.end(),
                       [](const CapturedLight& captured) { return isNear(captured.light); });
}

nlohmann::json describePhotographs(const std::vector<PagePhotograph>& photographs, PageParts& parts)
{
    nlohmann::json json = nlohmann::json::array();
    for (const PagePhotograph& photograph : photographs) {
        json.push_back({{"light", photograph.light},
                        {"stops", photograph.exposureStops},
                        {"part", parts.add("photographs", base64(photograph.jpeg))}});
    }
    return json;
}

nlohmann::json describe(const PageContent& content, PageParts& parts)
{
    const bool isNearField = hasNearLights(content.object);
    nlohmann::json shapes = {
        describeShape("", content.object, {true, isNearField || content.object.camera.has_value()}, parts)};
    for (const PageShape& shape : content.shapes) {
        shapes.push_back(describeShape(shape.name, shape.surface, {false, isNearField}, parts));
    }
    nlohmann::json materials = nlohmann::json::array(), notes = nlohmann::json::array();
    for (const Material* material : materialsOf(content)) {
        materials.push_back(describeMaterial(*material, parts));
    }
    for (const PageNote& note : content.notes) {
        notes.push_back({note.heading, note.text});
    }
    const glm::vec3 white = whiteIrradiance(content.object), light = glm::normalize(kFirstLight);
    return {{"title", content.title},
            {"shapes", shapes},
            {"sphereSide", kSphereSide},
            {"materials", materials},
            {"ownMaterials", content.object.materials.size()},
            {"lights", describeLights(content.object)},
            {"firstLight", {light.x, light.y, light.z}},
            {"white", {white.x, white.y, white.z}},
            {"stops", describeExposures(content, white)},
            {"photographs", describePhotographs(content.photographs, parts)},
            {"notes", notes}};
}

// Within a script element: nothing in it may look like the element's end or a comment's beginning.
std::string scriptText(const nlohmann::json& json)
{
    std::string text;
    for (const char c : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return text;
}

} // namespace

PageText makePage(const PageContent& content)
{
    PageParts parts;
    const std::string description = scriptText(describe(content, parts));
    const std::string elements = parts.elements();
    PageText page{filledPage({escaped(content.title), description, elements}), parts.shares()};
    page.shares.push_back({"script, style and shaders", page.html.size() - elements.size() - description.size()});
    page.shares.push_back({"description", page.html.size() - [&] {
                               size_t sum = 0;
                               for (const PageParts::Share& share : page.shares) {
                                   sum += share.bytes;
                               }
                               return sum;
                           }()});
    return page;
}

} // namespace nacre
