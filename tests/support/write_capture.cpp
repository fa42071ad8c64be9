#include "tests/support/write_capture.h"

#include <cmath>

#include <fmt/format.h>

#include "tests/support/temp_folder.h"

namespace nacre {
namespace fs = std::filesystem;

Image testPicture(int number, int width, int height, int channels)
{
    Image picture(width, height, channels);
    for (size_t i = 0; i < picture.values.size(); ++i) {
        const size_t step = (i * 37 + static_cast<size_t>(number) * 101) % 801;
        picture.values[i] = 0.1f + 0.001f * static_cast<float>(step);
    }
    return picture;
}

void writePicture(const fs::path& file, const Image& picture)
{
    fs::create_directories(file.parent_path());
    const std::string extension = file.extension().string();
    const bool eightBits = extension == ".tga" || extension == ".TGA" || extension == ".jpg" || extension == ".JPG";
    saveImage(file, picture,
              eightBits ? PixelType::uint8 : (extension == ".exr" ? PixelType::float32 : PixelType::uint16));
}

void writePicture(const fs::path& file, int number)
{
    writePicture(file, testPicture(number));
}

void writeMask(const fs::path& file, int firstInside, int width, int height)
{
    Image mask(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = firstInside; x < width; ++x) {
            mask.at(x, y) = 1;
        }
    }
    writePicture(file, mask);
}

std::string directionLines(int count)
{
    std::string lines;
    for (int i = 0; i < count; ++i) {
        const double azimuth = 0.7 * i;
        const double x = 0.5 * std::cos(azimuth);
        const double y = 0.5 * std::sin(azimuth);
        lines += fmt::format("{:.9f} {:.9f} {:.9f}\n", x, y, std::sqrt(0.75));
    }
    return lines;
}

void writeUwFolder(const fs::path& folder, const std::string& name, int count, const std::string& extension)
{
    for (int i = 0; i < count; ++i) {
        writePicture(folder / fmt::format("{}.{}{}", name, i, extension), i);
    }
    writeMask(folder / (name + ".mask.tga"));
}

void writeDiligentFolder(const fs::path& folder, int count)
{
    std::string names;
    std::string intensities;
    for (int i = 1; i <= count; ++i) {
        const std::string name = fmt::format("{:03}.png", i);
        writePicture(folder / name, i);
        names += name + "\n";
        intensities += fmt::format("{} {} {}\n", i, 2 * i, 3 * i);
    }
    writeText(folder / "filenames.txt", names);
    writeText(folder / "light_directions.txt", directionLines(count));
    writeText(folder / "light_intensities.txt", intensities);
    writeMask(folder / "mask.png");
}

void writeRtiFolder(const fs::path& folder, int count)
{
    std::string lines = fmt::format("{}\n", count);
    for (int i = 1; i <= count; ++i) {
        writePicture(folder / fmt::format("photo {}.png", i), i);
        lines += fmt::format("C:\\lab\\dome\\photo {}.png {} 0.5 2\n", i, 0.1 * i);
    }
    writeText(folder / "lights.lp", lines);
}

} // namespace nacre
