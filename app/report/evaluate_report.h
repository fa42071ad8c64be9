#pragma once
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "evaluation/held_out/held_out.h"

namespace nacre {

// What the user is told: a table of the photographs held out, errors of the normals where their truth is known, bytes
// and seconds.
std::string describe(const HeldOutEvaluation& evaluation, const std::optional<AngularError>& normals);

nlohmann::ordered_json documentOf(const HeldOutEvaluation& evaluation, const std::optional<AngularError>& normals);

// The photograph that is predicted worst, its prediction, and their difference, amplified as the caption says; cut to
// the object. All three under the one exposure that suits the capture.
Image worstSheet(const HeldOutEvaluation& evaluation);

} // namespace nacre
