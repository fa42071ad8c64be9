#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/exposure_merge.h"

namespace nacre {

// True for interlaced PNGs and progressive JPEGs: no row is complete before the end of the file, so decoders that
// answer row by row hold the whole picture all the same.
bool isProgressive(const std::filesystem::path& file);

// One exposure's file, read in bands of rows from top to bottom.
class ExposureFile {
public:
    ExposureFile(const Exposure& exposure, const Capture& capture);

    const std::filesystem::path& file() const { return file_; }
    // Known once the file was opened.
    const ExposureScale& scale() const { return scale_; }

    // Opens it to stay open, so that reads go on where the last one ended; otherwise it is closed with each band, and
    // the next one walks down from the top. Answers the bytes held in memory: the whole picture where its format cannot
    // be streamed, else 0.
    size_t keepOpen();
    // Writes an uncompressed copy, which can be streamed, and keeps that open instead.
    void spill(const std::filesystem::path& copyWithoutExtension);

    // Rows [first, last) of the capture's window as 3 channels each. A box of pixels that are averaged has full scale
    // in a channel where any of them has, so that it counts as clipped. Throws Error on unreadable files.
    void read(int first, int last, std::vector<glm::vec3>& rgb);
    void endBand();

private:
    ImageRows& open();
    void gatherWindow(int rows, int channels, std::vector<glm::vec3>& rgb) const;

    std::filesystem::path file_;   // the user's
    std::filesystem::path source_; // the same, or its copy
    TransferCurve curve_;
    double seconds_;
    FileWindow window_;
    float offset_;
    std::vector<float> values_; // rows of the file, where the window is not the whole of it
    ExposureScale scale_;
    std::optional<ImageRows> rows_;
    bool keptOpen_ = false;
};

// How many files a reader may keep open beside all that the process has open already.
size_t openFileAllowance();

} // namespace nacre
