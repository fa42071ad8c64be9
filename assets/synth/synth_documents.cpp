#include "assets/synth/synth_documents.h"

#include <nlohmann/json.hpp>

#include "assets/synth/synth_names.h"

namespace nacre {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

Json jsonOf(const Light& light)
{
    return {{"direction", jsonOf(light.direction)}, {"irradiance", jsonOf(light.irradiance)}};
}

Json photographDocument(const SynthScene& scene, size_t index)
{
    const SynthOptions& options = scene.options;
    Json photograph;
    if (options.exposures.size() == 1) {
        photograph["file"] = exposureFile(options, index, 0);
        photograph["exposureSeconds"] = options.exposures[0];
    } else {
        for (size_t e = 0; e < options.exposures.size(); ++e) {
            photograph["exposures"].push_back(
                {{"file", exposureFile(options, index, e)}, {"seconds", options.exposures[e]}});
        }
    }
    if (options.giveLights) {
        photograph["light"] = jsonOf(scene.lights[index]);
    }
    return photograph;
}

Json sphereDocument(const SynthOptions& options, const std::string& what)
{
    Json sphere;
    for (int i = 0; i < options.lights; ++i) {
        sphere["photographs"].push_back(photographFile(options, what, i));
    }
    sphere["mask"] = what + "_mask.png";
    return sphere;
}

Json parametersOf(const LambertGgx& m)
{
    return {
        {"model", "lambert+ggx"}, {"diffuse", jsonOf(m.diffuse)}, {"specular", jsonOf(m.specular)}, {"alpha", m.alpha}};
}

Json parametersOf(const AbcModel& m)
{
    return {{"model", "abc"}, {"kD", jsonOf(m.kD)}, {"A", jsonOf(m.A)}, {"B", m.B}, {"C", m.C}, {"ior", m.ior}};
}

// Measured materials have no parameters: their file's name, in "material", says what they are.
Json parametersOf(const std::shared_ptr<const BrdfTable>&)
{
    return {{"model", "table"}};
}

Json parametersOf(const std::shared_ptr<const RglBrdf>&)
{
    return {{"model", "RGL database"}};
}

Json parametersOf(const SgdModel& m)
{
    return {{"model", "sgd"},           {"rhoD", jsonOf(m.rhoD)}, {"rhoS", jsonOf(m.rhoS)},
            {"alpha", jsonOf(m.alpha)}, {"p", jsonOf(m.p)},       {"F0", jsonOf(m.F0)},
            {"F1", jsonOf(m.F1)},       {"kap", jsonOf(m.kap)},   {"lambda", jsonOf(m.lambda)},
            {"c", jsonOf(m.c)},         {"k", jsonOf(m.k)},       {"theta0", jsonOf(m.theta0)}};
}

Json parametersOfModel(const BrdfModel& model)
{
    return std::visit([](const auto& m) { return parametersOf(m); }, model);
}

std::string textOf(const Json& json)
{
    return json.dump(2) + "\n";
}

} // namespace

std::string captureDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre capture"},
              {"version", 1},
              {"name", scene.options.shape == SynthShape::sphere ? "sphere" : "bumpy"},
              {"transfer", "linear"},
              {"mask", "mask.png"},
              {"truthNormals", "truth/normals.exr"}};
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        json["photographs"].push_back(photographDocument(scene, i));
    }
    json["mirrorSphere"] = sphereDocument(scene.options, "mirror");
    json["diffuseSphere"] = sphereDocument(scene.options, "diffuse");
    return textOf(json);
}

std::string lightsDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre lights"}, {"version", 1}};
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        Json light = jsonOf(scene.lights[i]);
        light["photograph"] = exposureFile(scene.options, i, 0);
        json["lights"].push_back(light);
    }
    return textOf(json);
}

std::string brdfDocument(const SynthScene& scene)
{
    Json json{{"format", "nacre brdf"},
              {"version", 1},
              {"material", scene.options.material},
              {"parameters", parametersOfModel(scene.models[0])},
              {"radianceScale", scene.sensor.gain},
              {"noise", scene.sensor.noise},
              {"diffuseSphereReflectance", jsonOf(scene.options.sphereReflectance)},
              {"seed", scene.options.seed}};
    for (size_t i = 0; i < scene.options.patches.size(); ++i) {
        json["patches"].push_back(
            {{"material", scene.options.patches[i]}, {"parameters", parametersOfModel(scene.models[i + 1])}});
    }
    return textOf(json);
}

} // namespace nacre
