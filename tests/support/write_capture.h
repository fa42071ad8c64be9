#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/image.h"

namespace nacre {

// Small captures for tests. Their pictures are kWidth x kHeight unless another size is asked for.
inline constexpr int kTestWidth = 8;
inline constexpr int kTestHeight = 6;

// Values in [0.1, 0.9] that tell pixels, channels and pictures (by number) apart.
Image testPicture(int number, int width = kTestWidth, int height = kTestHeight, int channels = 3);

// 8 bits for .tga and .jpg, float for .exr, 16 bits otherwise. Folders that are missing are made.
void writePicture(const std::filesystem::path& file, const Image& picture);
void writePicture(const std::filesystem::path& file, int number);

// White right of the column `firstInside`, black left of it.
void writeMask(const std::filesystem::path& file, int firstInside = 2, int width = kTestWidth,
               int height = kTestHeight);

// `count` different unit directions in the upper hemisphere, as "x y z" lines.
std::string directionLines(int count);

// NAME.0.EXT ... and NAME.mask.tga.
void writeUwFolder(const std::filesystem::path& folder, const std::string& name, int count,
                   const std::string& extension = ".tga");
// 001.png ... with filenames.txt, light_directions.txt, light_intensities.txt ("i 2i 3i" for light i from 1), mask.png.
void writeDiligentFolder(const std::filesystem::path& folder, int count);
// photo 1.png ... and lights.lp, whose names carry a folder that is not there.
void writeRtiFolder(const std::filesystem::path& folder, int count);

} // namespace nacre
