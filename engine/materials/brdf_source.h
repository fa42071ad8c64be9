#pragma once
#include <filesystem>
#include <string>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// What `nacre brdf` can be asked about.
struct BrdfSource {
    std::string name;
    std::string kind; // for the user: "MERL table", "microfacet model", ...
    BrdfModel model;
    bool relative = false; // f is 1/sr only up to one factor
};

// A specification as parseMaterial takes it.
BrdfSource loadBrdfSource(const std::string& specification, const std::filesystem::path& fitsFolder);

// "RGL database, ...", "MERL file, folded to a table", "table", "model".
std::string kindOf(const std::string& specification, const BrdfModel& model);

// The table that the source is, or its model tabulated over the whole domain.
BrdfTable tableOfSource(const BrdfSource& source, int threads);

} // namespace nacre
