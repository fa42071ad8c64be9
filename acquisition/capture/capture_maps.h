#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "acquisition/capture/capture.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// 1 where a picture's alpha is above one half; empty where it has none that has both, whatever its colours are.
std::vector<uint8_t> alphaMask(const std::filesystem::path& file);

struct MaskPicture {
    std::vector<uint8_t> inside; // 1 on the object
    bool isAlpha = false;        // told by the alpha channel, not by colours
};

// Inside is where alpha, if it varies, else the brightest channel is above one half. Throws Error where nothing is or
// the size differs from width x height (0: any).
MaskPicture loadMask(const std::filesystem::path& file, int width, int height);

// What of the files' pixels a capture takes in, once the files' size is known: sets width and height. Throws Error,
// naming `listing`, where the window is not inside.
void fitWindow(Capture& capture, int fileWidth, int fileHeight, const std::filesystem::path& listing);

// A mask of the files' size to the capture's; a box is inside where all of it is. Throws Error, naming `file`, where
// nothing is left.
std::vector<uint8_t> windowedMask(const std::vector<uint8_t>& mask, const Capture& capture,
                                  const std::filesystem::path& file);

// Marks of the files' size to the capture's: a box is marked where any of it is.
std::vector<uint8_t> windowedMarks(const std::vector<uint8_t>& marks, const Capture& capture);

// Labels of the files' size to the capture's: a box has the label that most of its pixels have, of several the
// smallest.
std::vector<uint8_t> windowedLabels(const std::vector<uint8_t>& labels, const Capture& capture);

// Normals of the files' size to the capture's: a box has the mean direction where it has normals all over, else none.
// Throws Error, naming `file`, where the size differs from the photographs'.
NormalMap windowedNormals(const NormalMap& normals, const Capture& capture, const std::filesystem::path& file);

// The true normals of a benchmark: MATLAB `.mat` with an h x w x 3 array (DiLiGenT's `Normal_gt`), or what
// loadNormalMap reads. Zero vectors are no data.
NormalMap loadTrueNormals(const std::filesystem::path& file);

} // namespace nacre
