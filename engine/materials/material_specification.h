#pragma once
#include <filesystem>
#include <string>

#include "engine/brdf/brdf_models.h"
#include "engine/surface/surface.h"

namespace nacre {

// One way of naming a material in the whole program:
//   NAME.nacre, NAME.nacre#skin, NAME.nacre#2        the first of a surface's, one by its name or by its number from 1
//   merl:FILE, rgl:FILE, table:FILE                  measured ones (docs/formats.md); a file's name alone will do where
//                                                    it ends in .binary, .bsdf or .exr
//   merl-abc:NAME, merl-sgd:NAME                     the published fits, from the folder that holds their CSV files
//   lambert:R,G,B                                    albedo; one number serves all channels
//   ggx:diffuse=R,G,B;specular=R,G,B;alpha=A         in any order; what is left out keeps LambertGgx's default
// Throws Error (usage) that names what is wrong, and near names where a fit is not found; Error (data) about a file.
NamedBrdf parseMaterial(const std::string& specification, const std::filesystem::path& fitsFolder);

// The same as a surface has it: a surface's with its coverage and its smaller model, anything that is no table
// tabulated at MERL's density.
Material loadMaterial(const std::string& specification, const std::filesystem::path& fitsFolder, int threads = 0);

// The folder of merl_abc_params.csv and merl_sgd_params.csv: `option` where it is given, else the environment
// variable NACRE_FITS_DIR, else empty.
std::filesystem::path fitsFolderFrom(const std::filesystem::path& option);

// What `nacre brdf` can be asked about.
struct BrdfSource {
    std::string name;
    std::string kind; // for the user: "MERL table", "microfacet model", ...
    BrdfModel model;
    bool relative = false; // f is 1/sr only up to one factor
};

BrdfSource loadBrdfSource(const std::string& specification, const std::filesystem::path& fitsFolder);

// "RGL database, ...", "MERL file, folded to a table", "table", "model".
std::string kindOf(const std::string& specification, const BrdfModel& model);

// The table that the source is, or its model tabulated over the whole domain.
BrdfTable tableOfSource(const BrdfSource& source, int threads);

} // namespace nacre
