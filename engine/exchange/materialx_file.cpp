#include "engine/exchange/materialx_file.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "engine/files/markup.h"

namespace nacre {
namespace {

// MaterialX names are ASCII letters, digits and underscores, and begin with no digit.
std::string nodeName(const std::string& text, std::set<std::string>& taken)
{
    std::string name = text.empty() || (text[0] >= '0' && text[0] <= '9') ? "m" : "";
    for (const char c : text) {
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        name += isPlain ? c : '_';
    }
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) {
        unique = fmt::format("{}_{}", name, i);
    }
    return unique;
}

std::string scalar(const char* name, float value)
{
    return fmt::format("    <input name=\"{}\" type=\"float\" value=\"{:.5g}\" />\n", name, value);
}

std::string colour(const char* name, const glm::vec3& v)
{
    return fmt::format("    <input name=\"{}\" type=\"color3\" value=\"{:.5g}, {:.5g}, {:.5g}\" />\n", name, v.x, v.y,
                       v.z);
}

float largestChannel(const glm::vec3& v)
{
    return std::max({v.x, v.y, v.z});
}

std::string inputsOf(const LobeShape& shape, const LobeColours& colours)
{
    // A weight and a tint whose largest channel is 1.
    const auto weighted = [](const char* weight, const char* tint, const glm::vec3& c) {
        const float most = largestChannel(c);
        return scalar(weight, most) + colour(tint, most > 0 ? c / most : glm::vec3(1));
    };
    std::string inputs = scalar("base", 1);
    inputs += colour("base_color", shape.isMetal() ? colours.specular : colours.diffuse);
    inputs += scalar("metalness", shape.isMetal() ? 1 : 0);
    if (shape.isMetal()) {
        inputs += scalar("specular", 1) + colour("specular_color", glm::vec3(1));
    } else {
        inputs += weighted("specular", "specular_color", colours.specular) + scalar("specular_IOR", shape.ior);
    }
    inputs += scalar("specular_roughness", shape.roughness);
    if (colours.sheen != glm::vec3(0)) {
        inputs += weighted("sheen", "sheen_color", colours.sheen) + scalar("sheen_roughness", shape.sheenRoughness);
    }
    return inputs;
}

} // namespace

std::string materialXText(const std::vector<MaterialXMaterial>& materials, float radianceScale)
{
    std::set<std::string> taken;
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<materialx version=\"1.38\" colorspace=\"lin_rec709\"";
    if (radianceScale != 1) {
        text += fmt::format(" doc=\"Radiance is to be multiplied by {:.5g}\"", radianceScale);
    }
    text += ">\n";
    for (const MaterialXMaterial& material : materials) {
        const std::string name = nodeName(material.name, taken), shader = nodeName(name + "_shader", taken),
                          title = escaped(material.name);
        text +=
            fmt::format("  <standard_surface name=\"{}\" type=\"surfaceshader\" version=\"1.0.1\" uiname=\"{}\">\n{}"
                        "  </standard_surface>\n",
                        shader, title, inputsOf(material.shape, material.colours));
        text += fmt::format("  <surfacematerial name=\"{}\" type=\"material\" uiname=\"{}\">\n"
                            "    <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"{}\" />\n"
                            "  </surfacematerial>\n",
                            name, title, shader);
    }
    return text + "</materialx>\n";
}

} // namespace nacre
