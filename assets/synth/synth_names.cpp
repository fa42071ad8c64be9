#include "assets/synth/synth_names.h"

#include <fmt/format.h>

namespace nacre {
namespace {

std::string extensionOf(SynthFormat format)
{
    return format == SynthFormat::exr ? ".exr" : ".png";
}

} // namespace

std::string numberedName(const SynthOptions& options, const std::string& what, size_t index)
{
    const size_t digits = std::max<size_t>(2, std::to_string(options.lights).size());
    return fmt::format("{}_{:0{}}", what, index + 1, digits);
}

std::string photographFile(const SynthOptions& options, const std::string& what, size_t index)
{
    return numberedName(options, what, index) + extensionOf(options.format);
}

// Members of a bracket are told apart by a letter, a for the first.
std::string exposureFile(const SynthOptions& options, size_t index, size_t exposure)
{
    if (options.exposures.size() == 1) {
        return photographFile(options, "object", index);
    }
    return fmt::format("{}_{}{}", numberedName(options, "object", index), static_cast<char>('a' + exposure),
                       extensionOf(options.format));
}

} // namespace nacre
