#pragma once
#include <filesystem>

#include "engine/brdf/brdf_table.h"

namespace nacre {

// The table as a KTX 2.0 3D texture (Khronos, KTX File Format Specification, version 2.0):
// VK_FORMAT_R16G16B16A16_SFLOAT, RGB = f, A = confidence, one level, no supercompression; shape and domain under the
// key "nacre:brdfTable" as in the EXR (docs/formats.md). Whole or not at all. Returns how many values lay beyond what
// 16 bits hold and were clamped to 65504.
size_t saveKtx2(const std::filesystem::path& file, const BrdfTable& table);

} // namespace nacre
