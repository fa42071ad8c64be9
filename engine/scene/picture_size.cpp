#include "engine/scene/picture_size.h"

#include <charconv>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

PictureSize sizeFromArgument(const std::string& name, const std::string& text)
{
    PictureSize size;
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    bool understood = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    if (understood) {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        understood = height.ec == std::errc() && height.ptr == end;
    }
    if (!understood || size.width < 1 || size.height < 1) {
        throw Error("", fmt::format("{} {} is no size", name, text), "WIDTHxHEIGHT in pixels, e.g. 640x480",
                    Error::kUsage);
    }
    return size;
}

} // namespace nacre
