#pragma once
#include <filesystem>
#include <string>

#include "engine/scene/brdf_models.h"

namespace nacre {

// One way of naming a material in the whole program:
//   lambert:R,G,B                                    albedo; one number serves all channels
//   ggx:diffuse=R,G,B;specular=R,G,B;alpha=A         in any order; what is left out keeps LambertGgx's default
//   merl-abc:NAME, merl-sgd:NAME                     the published fits, from the folder that holds their CSV files
//   merl:FILE, rgl:FILE, table:FILE                  measured ones (docs/formats.md); a file's name alone will do where
//                                                    it ends in .binary, .bsdf or .exr
// Throws Error (usage) that names what is wrong, and near names where a fit is not found; Error (data) about a file.
NamedBrdf parseMaterial(const std::string& specification, const std::filesystem::path& fitsFolder);

// The folder of merl_abc_params.csv and merl_sgd_params.csv: `option` (--fits) where it is given, else the environment
// variable NACRE_FITS_DIR, else empty.
std::filesystem::path fitsFolderFrom(const std::filesystem::path& option);

} // namespace nacre
