#include "engine/scene/scene_names.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr std::array kNormalYs = {std::pair("gl", NormalY::gl), std::pair("dx", NormalY::dx)};

constexpr std::array kMotions = {std::pair("turntable", LightMotion::turntable), std::pair("sweep", LightMotion::sweep),
                                 std::pair("object", LightMotion::object), std::pair("none", LightMotion::none)};

constexpr std::array kPaths = {std::pair("auto", RenderPath::automatic), std::pair("direct", RenderPath::direct),
                               std::pair("ball", RenderPath::ball)};

constexpr std::array kShows = {std::pair("picture", Show::picture),  std::pair("normals", Show::normals),
                               std::pair("labels", Show::labels),    std::pair("coverage", Show::coverage),
                               std::pair("theta-h", Show::thetaH),   std::pair("theta-d", Show::thetaD),
                               std::pair("verdicts", Show::verdicts)};

constexpr std::array kToneCurves = {std::pair("srgb", kToneSrgb), std::pair("filmic", kToneFilmic)};

constexpr std::array kResidualUses = {std::pair("on", ResidualUse::on), std::pair("off", ResidualUse::off),
                                      std::pair("alone", ResidualUse::alone)};

template <class Names> auto valueOf(const Names& names, const char* what, const std::string& name, const char* expected)
{
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& known) { return known.first == name; });
    if (found == names.end()) {
        throw Error("", fmt::format("{} {} is not known", what, name), expected, Error::kUsage);
    }
    return found->second;
}

template <class Names> std::string nameIn(const Names& names, const auto& value)
{
    return std::find_if(names.begin(), names.end(), [&](const auto& known) { return known.second == value; })->first;
}

} // namespace

NormalY normalYFromName(const std::string& name)
{
    return valueOf(kNormalYs, "normal-y", name, "gl (green points up) or dx (down)");
}

std::string nameOf(NormalY normalY)
{
    return nameIn(kNormalYs, normalY);
}

LightMotion motionFromName(const std::string& name)
{
    return valueOf(kMotions, "motion", name, "turntable, sweep, object or none");
}

std::string nameOf(LightMotion motion)
{
    return nameIn(kMotions, motion);
}

RenderPath pathFromName(const std::string& name)
{
    return valueOf(kPaths, "path", name, "auto, direct or ball");
}

std::string nameOf(RenderPath path)
{
    return nameIn(kPaths, path);
}

Show showFromName(const std::string& name)
{
    return valueOf(kShows, "show", name,
                   "picture, normals, labels, coverage, theta-h, theta-d, or nacre view's verdicts");
}

std::string nameOf(Show show)
{
    return nameIn(kShows, show);
}

int toneCurveFromName(const std::string& name)
{
    return valueOf(kToneCurves, "tone", name, "srgb or filmic");
}

std::string nameOfToneCurve(int toneCurve)
{
    return nameIn(kToneCurves, toneCurve);
}

ResidualUse residualUseFromName(const std::string& name)
{
    return valueOf(kResidualUses, "layer", name, "on, off or alone");
}

std::string nameOf(ResidualUse use)
{
    return nameIn(kResidualUses, use);
}

} // namespace nacre
