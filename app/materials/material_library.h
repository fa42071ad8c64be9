#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// A material that can be used, or a file that should have been one.
struct LibraryEntry {
    std::string specification; // to type
    std::string kind{};        // for the user
    std::string problem{};     // why it cannot be used; empty where it can
    size_t bytes = 0;          // of the file; of the model in memory for a surface's material or a fit
    // Of the configurations above the horizon; empty for formulas, and where a table does not say.
    std::optional<double> measured{};
    BrdfModel model{};
};

// What the places hold, in their order, by name within a folder: NAME.nacre (each of its materials), .binary, .bsdf and
// our .exr tables in a folder and in the folders in it; or one material that is named. What cannot be used is listed
// with its error.
std::vector<LibraryEntry> libraryOf(const std::vector<std::string>& places, const std::filesystem::path& fitsFolder);

// All published fits, ABC before SGD. Throws Error where the folder lacks them.
std::vector<LibraryEntry> fitEntries(const std::filesystem::path& fitsFolder);

// One line an entry, problems last.
void print(const std::vector<LibraryEntry>& entries);
nlohmann::json jsonOf(const std::vector<LibraryEntry>& entries);

} // namespace nacre
