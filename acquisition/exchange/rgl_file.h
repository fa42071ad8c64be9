#pragma once
#include <filesystem>
#include <string>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// A material as the RGL database has them, `NAME.bsdf` (see RglBrdf; docs/formats.md): isotropic, in linear Rec. 709
// and as spectra of 400 to 700 nm, the smoothest that have this colour under D65, which Mitsuba's `measured` asks for.
// What the model does not cover is written as it extrapolates. Whole or not at all.
void saveRgl(const std::filesystem::path& file, const BrdfModel& model, const std::string& description,
             int threads = 0);

} // namespace nacre
