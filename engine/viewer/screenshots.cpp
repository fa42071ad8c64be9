#include "engine/viewer/screenshots.h"

#include <fmt/format.h>

#include "engine/files/whole_file.h"

namespace nacre {
namespace {

constexpr const char* kStateAttribute = "nacre:state"; // its state file's text

std::filesystem::path stateFileOf(std::filesystem::path picture)
{
    return picture.replace_extension(".json");
}

} // namespace

void saveScreenshot(const std::filesystem::path& file, const Image& picture, const ViewState& state)
{
    const std::string text = textOf(state, file.parent_path());
    saveImage(file, picture, PixelType::uint8, {{kStateAttribute, text}});
    writeTextFile(stateFileOf(file), text);
}

std::filesystem::path nextScreenshot(const std::filesystem::path& folder)
{
    for (int number = 1;; ++number) {
        const std::filesystem::path file = folder / fmt::format("nacre-{:04}.png", number);
        if (!std::filesystem::exists(file) && !std::filesystem::exists(stateFileOf(file))) {
            return file;
        }
    }
}

} // namespace nacre
