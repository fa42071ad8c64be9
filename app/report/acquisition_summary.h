#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "acquisition/chain/acquire.h"

namespace nacre {

// What the user is told of a capture and its lights: directions as polar angle and azimuth, irradiances, the
// disagreement with the diffuse sphere's shading.
std::string describe(const Capture& capture);
std::string describe(const Capture& capture, const Rig& rig);
// How many photographs were given to an estimate, where that was not all of them.
std::string describeGiven(const Capture& capture, const NormalEstimate& estimate);
std::string describe(const std::vector<StageTime>& times);
// Method, what it remarked, and how the observations were judged.
std::string describeNormals(const Capture& capture, const NormalEstimate& estimate);
// The warnings alone, one a line.
std::string describeWarnings(const NormalEstimate& estimate);

// Degrees between the rig's directions and those of another file of lights, by the photographs' names, by their order
// where the file names none of them. The rig has the lights of the capture's photographs `given`.
std::string describeDisagreement(const Capture& capture, const std::vector<size_t>& given, const Rig& rig,
                                 const std::filesystem::path& otherLights);

std::string describeBrdf(const Acquisition& acquisition);
std::string describe(const InterpolationChoice& choice); // empty where nothing was chosen
// Size, coordinates and measured share of a table, as the end of a sentence.
std::string describe(const BrdfTable& table);
// Polar angle and azimuth in degrees, irradiance: one row under the heading kLightColumns.
std::string describe(const Light& light);
inline constexpr const char* kLightColumns = "  polar  azimuth      red    green     blue";

nlohmann::json summaryOf(const Capture& capture, const NormalEstimate& estimate);
nlohmann::json findingsOf(const NormalEstimate& estimate); // of the lights and of the normals
nlohmann::json summaryOf(const Capture& capture, const Acquisition& acquisition);

} // namespace nacre
