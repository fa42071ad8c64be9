#pragma once
#include <string>

#include "assets/synth/synth_options.h"

namespace nacre {

// Names of a synthetic capture's files. Photographs count from 1, with as many digits as the last of them needs.
std::string numberedName(const SynthOptions& options, const std::string& what, size_t index);
std::string photographFile(const SynthOptions& options, const std::string& what, size_t index);
std::string exposureFile(const SynthOptions& options, size_t index, size_t exposure);

} // namespace nacre
