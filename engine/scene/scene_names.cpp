#include "engine/scene/scene_names.h"

#include <array>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr std::array kShows = {std::pair("picture", Show::picture),  std::pair("normals", Show::normals),
                               std::pair("labels", Show::labels),    std::pair("coverage", Show::coverage),
                               std::pair("theta-h", Show::thetaH),   std::pair("theta-d", Show::thetaD),
                               std::pair("verdicts", Show::verdicts)};

constexpr std::array kResidualUses = {std::pair("on", ResidualUse::on), std::pair("off", ResidualUse::off),
                                      std::pair("alone", ResidualUse::alone)};

Error notKnown(const char* option, const std::string& value, const char* expected)
{
    return Error("", fmt::format("{} {} is not known", option, value), expected, Error::kUsage);
}

} // namespace

Show showFromName(const std::string& name)
{
    for (const auto& [known, show] : kShows) {
        if (name == known) {
            return show;
        }
    }
    if (!name.empty()) {
        throw notKnown("--show", name,
                       "picture, normals, labels, coverage, theta-h, theta-d, or nacre view's verdicts");
    }
    return Show::picture;
}

std::string nameOf(Show show)
{
    for (const auto& [name, known] : kShows) {
        if (show == known) {
            return name;
        }
    }
    return kShows[0].first;
}

int toneCurveFromName(const std::string& name)
{
    if (!name.empty() && name != "srgb" && name != "filmic") {
        throw notKnown("--tone", name, "srgb or filmic");
    }
    return name == "filmic" ? kToneFilmic : kToneSrgb;
}

std::string nameOfToneCurve(int toneCurve)
{
    return toneCurve == kToneFilmic ? "filmic" : "srgb";
}

ResidualUse residualUseFromName(const std::string& name)
{
    for (const auto& [known, use] : kResidualUses) {
        if (name == known) {
            return use;
        }
    }
    if (!name.empty()) {
        throw notKnown("--layer", name, "on, off or alone");
    }
    return ResidualUse::on;
}

std::string nameOf(ResidualUse use)
{
    for (const auto& [name, known] : kResidualUses) {
        if (use == known) {
            return name;
        }
    }
    return kResidualUses[0].first;
}

} // namespace nacre
