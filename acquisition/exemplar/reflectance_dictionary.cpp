#include "acquisition/exemplar/reflectance_dictionary.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace nacre {

namespace {

// ABC lobes D = A / (1 + B (1 - cos thetaH))^C (Loew et al. 2012): B sets the width (1/sqrt(B) radians), C the tail.
constexpr float kWidths[] = {20, 150, 1000, 7000, 50000};
constexpr float kTails[] = {0.6f, 1.0f, 1.6f, 2.6f};
// The lobe's peak over the diffuse part; 0: no diffuse part, as in metals.
constexpr float kPeaks[] = {0.3f, 1.5f, 6, 25, 100, 0};
constexpr float kIor = 1.6f;

NamedBrdf builtInLobe(float width, float tail, float peak)
{
    const float f0 = (kIor - 1) * (kIor - 1) / ((kIor + 1) * (kIor + 1));
    AbcModel model;
    model.kD = glm::vec3(peak > 0 ? 1.0f : 0.0f);
    model.A = glm::vec3((peak > 0 ? peak : 1.0f) / f0);
    model.B = width;
    model.C = tail;
    model.ior = kIor;
    return {fmt::format("built-in lobe of B {:g}, C {:g}, {}", width, tail,
                        peak > 0 ? fmt::format("{:g} x diffuse", peak) : "no diffuse part"),
            model};
}

std::string withoutNumber(std::string name)
{
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back()))) {
        name.pop_back();
    }
    return name;
}

void addFits(const std::string& family, const std::vector<NamedBrdf>& fits, const std::vector<std::string>& excluded,
             std::vector<NamedBrdf>& dictionary)
{
    for (const NamedBrdf& fit : fits) {
        const bool out = std::any_of(excluded.begin(), excluded.end(), [&](const std::string& name) {
            return withoutNumber(name) == withoutNumber(fit.name);
        });
        if (!out) {
            dictionary.push_back({family + ":" + fit.name, fit.model});
        }
    }
}

} // namespace

std::vector<NamedBrdf> makeReflectanceDictionary(const std::filesystem::path& fitsFolder,
                                                 const std::vector<std::string>& excluded)
{
    std::vector<NamedBrdf> dictionary;
    dictionary.push_back({"Lambert", LambertGgx{glm::vec3(0.5f), glm::vec3(0), 0.5f}});
    for (const float width : kWidths) {
        for (const float tail : kTails) {
            for (const float peak : kPeaks) {
                dictionary.push_back(builtInLobe(width, tail, peak));
            }
        }
    }
    if (!fitsFolder.empty()) {
        addFits("merl-abc", loadAbcFits(fitsFolder / "merl_abc_params.csv"), excluded, dictionary);
        addFits("merl-sgd", loadSgdFits(fitsFolder / "merl_sgd_params.csv"), excluded, dictionary);
    }
    return dictionary;
}

} // namespace nacre
