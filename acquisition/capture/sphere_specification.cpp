#include "acquisition/capture/sphere_specification.h"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "in-picture:";

} // namespace

std::optional<SphereInPicture> sphereInPicture(const std::string& option, const fs::path& specification)
{
    const std::string& text = specification.native();
    if (!text.starts_with(kPrefix)) {
        return std::nullopt;
    }
    SphereInPicture sphere;
    const char* at = text.data() + kPrefix.size();
    const char* const end = text.data() + text.size();
    bool understood = true;
    for (int* number : {&sphere.x, &sphere.y, &sphere.width, &sphere.height}) {
        if (number != &sphere.x) {
            understood = understood && at != end && *at++ == ',';
        }
        const auto [next, problem] = std::from_chars(at, end, *number);
        understood =
            understood && problem == std::errc() && *number >= (number == &sphere.x || number == &sphere.y ? 0 : 1);
        at = next;
    }
    if (understood && at != end && *at == ',') {
        sphere.mask = std::string(at + 1, end);
        at = end;
        understood = !sphere.mask.empty();
    }
    if (!understood || at != end) {
        throw Error("", fmt::format("{} {} is not understood", option, text),
                    "in-picture:X,Y,W,H in whole pixels of the photographs, and a mask after a comma if you like",
                    Error::kUsage);
    }
    return sphere;
}

std::string rectangleOf(const SphereInPicture& sphere)
{
    return fmt::format("{},{},{},{}", sphere.x, sphere.y, sphere.width, sphere.height);
}

SpherePhotographs photographsOfSphere(const SphereInPicture& sphere, const Capture& capture)
{
    SpherePhotographs photographs;
    photographs.source = fmt::format("the sphere in the picture at {}", rectangleOf(sphere));
    photographs.photographs = capture.photographs;
    photographs.inPicture = sphere;
    return photographs;
}

} // namespace nacre
