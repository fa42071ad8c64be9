#pragma once
#include <filesystem>

namespace nacre::test {

// What the state files of tests/golden name, computed afresh, the same bytes on every run: sphere.exr, solid.exr,
// cloth.exr, head.exr (normals), copper.nacre, linen.nacre, jade.nacre, violet.nacre (materials), patches.nacre (three
// of them, albedo factors), studio.exr (an environment), merl_abc_params.csv (a metal) and shaded.nacre (one
// material, albedo factors, a residual layer). Only those that `state` names are made, beside it.
void writeGoldenInputs(const std::filesystem::path& state);

} // namespace nacre::test
