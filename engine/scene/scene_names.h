#pragma once
#include <string>

#include "engine/lights/light_motion.h"
#include "engine/scene/false_colour.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/residual_layer.h"

namespace nacre {

// The words by which command lines and state files choose. The inverses answer the word. Throw Error (usage).
NormalY normalYFromName(const std::string& name);
std::string nameOf(NormalY normalY);
LightMotion motionFromName(const std::string& name);
std::string nameOf(LightMotion motion);
RenderPath pathFromName(const std::string& name);
std::string nameOf(RenderPath path);
Show showFromName(const std::string& name);
std::string nameOf(Show show);
int toneCurveFromName(const std::string& name);
std::string nameOfToneCurve(int toneCurve);
ResidualUse residualUseFromName(const std::string& name);
std::string nameOf(ResidualUse use);

} // namespace nacre
