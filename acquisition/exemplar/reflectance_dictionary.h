#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// Known reflectances to explain an object by. Built in: Lambert, and Lambert plus an ABC lobe over a grid of widths,
// tails and strengths, from matt to metal. `fitsFolder` (empty: none) adds the published fits, named merl-abc:NAME and
// merl-sgd:NAME. `excluded` leaves out published fits by NAME, in both families and with their numbered siblings
// (gold-paint takes gold-paint2 along).
std::vector<NamedBrdf> makeReflectanceDictionary(const std::filesystem::path& fitsFolder,
                                                 const std::vector<std::string>& excluded);

} // namespace nacre
