#include "acquisition/capture/photograph_files.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::streamoff kPngInterlaceByte = 28; // behind the signature: IHDR's length and name, 12 bytes of its data

// ITU-T T.81 (JPEG), 1992, table B.1: markers that follow each other with a length each, up to the start of the frame.
bool isProgressiveFrame(std::ifstream& stream)
{
    stream.seekg(2); // start of image
    uint8_t head[4]; // 0xff, marker, length
    while (stream.read(reinterpret_cast<char*>(head), sizeof head) && head[0] == 0xff) {
        const int marker = head[1];
        if (marker == 0xff) { // a fill byte
            stream.seekg(-3, std::ios::cur);
            continue;
        }
        const bool tables = marker == 0xc4 || marker == 0xc8 || marker == 0xcc;
        if (marker >= 0xc0 && marker <= 0xcf && !tables) {
            return (marker & 3) == 2; // SOF2, 6, 10, 14
        }
        stream.seekg((head[2] << 8 | head[3]) - 2, std::ios::cur);
    }
    return false;
}

} // namespace

bool isProgressive(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    char start[kPngSignature.size()] = {};
    stream.read(start, sizeof start);
    const std::string_view signature(start, sizeof start);
    if (signature == kPngSignature) {
        stream.seekg(kPngInterlaceByte);
        return stream.get() == 1;
    }
    return signature.starts_with("\xff\xd8") && isProgressiveFrame(stream);
}

namespace {

// For outputs, libraries and the files that threads open for a moment.
constexpr size_t kSpareFiles = 32;

FileWindow windowOf(const Capture& capture)
{
    FileWindow window = capture.window;
    if (window.fileWidth == 0) {
        window.width = window.fileWidth = capture.width;
        window.height = window.fileHeight = capture.height;
    }
    return window;
}

bool isWhole(const FileWindow& window)
{
    return window.width == window.fileWidth && window.height == window.fileHeight && window.box == 1;
}

// Writes the picture bit by bit as it is, in a format that streams; answers the copy. The codes keep their depth: as
// 16-bit numbers 8-bit ones would come back a rounding away.
fs::path saveCopy(fs::path file, const Image& picture, const std::string& pixelType)
{
    if (pixelType == "uint8") {
        file += ".png";
        saveImage(file, picture, PixelType::uint8, {{"png:compressionLevel", "0"}});
    } else {
        file += ".tif";
        const PixelType type = pixelType == "uint16" ? PixelType::uint16 : PixelType::float32;
        saveImage(file, picture, type, {{"compression", "none"}});
    }
    return file;
}

} // namespace

ExposureFile::ExposureFile(const Exposure& exposure, const Capture& capture)
    : file_(exposure.file), source_(exposure.file), curve_(capture.curve), seconds_(exposure.seconds),
      window_(windowOf(capture)), offset_(capture.offset)
{
}

ImageRows& ExposureFile::open()
{
    rows_.emplace(source_, curve_);
    const ImageHeader& header = rows_->header();
    if (header.width != window_.fileWidth || header.height != window_.fileHeight) {
        throw Error(file_, fmt::format("is {} x {} now", header.width, header.height),
                    fmt::format("{} x {} as when the capture was loaded", window_.fileWidth, window_.fileHeight));
    }
    if (source_ == file_) {
        scale_ = exposureScaleOf(header.pixelType, seconds_);
        scale_.offset = offset_;
    }
    return *rows_;
}

size_t ExposureFile::keepOpen()
{
    const ImageRows& rows = open();
    keptOpen_ = true;
    const bool streams = rows.streams() && !isProgressive(source_);
    return streams ? 0 : size_t{sizeof(float)} * window_.fileWidth * window_.fileHeight * rows.header().channels;
}

void ExposureFile::spill(const fs::path& copyWithoutExtension)
{
    // Undecoded, so that integers stay integers and the copy reads as the file did.
    rows_.emplace(file_, TransferCurve::linear);
    const std::string pixelType = rows_->header().pixelType;
    Image picture(window_.fileWidth, window_.fileHeight, rows_->channels());
    rows_->read(0, window_.fileHeight, picture.values);
    rows_.reset(); // the picture that it holds
    source_ = saveCopy(copyWithoutExtension, picture, pixelType);
    picture = {};
    keepOpen();
}

void ExposureFile::read(int first, int last, std::vector<glm::vec3>& rgb)
{
    ImageRows& rows = rows_ ? *rows_ : open();
    const int width = window_.width / window_.box;
    const size_t pixels = static_cast<size_t>(last - first) * width;
    rgb.resize(pixels);
    if (!isWhole(window_)) {
        const int fileFirst = window_.y + first * window_.box;
        const int fileLast = window_.y + last * window_.box;
        values_.resize(static_cast<size_t>(fileLast - fileFirst) * window_.fileWidth * rows.channels());
        rows.read(fileFirst, fileLast, values_);
        gatherWindow(last - first, rows.channels(), rgb);
        return;
    }
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const std::span values(&rgb[0].x, 3 * pixels);
    if (rows.channels() == 3) {
        rows.read(first, last, values);
    } else {
        rows.read(first, last, values.first(pixels));
        for (size_t i = pixels; i-- > 0;) { // grey lies in front: spread it from the end
            rgb[i] = glm::vec3(values[i]);
        }
    }
}

void ExposureFile::gatherWindow(int rows, int channels, std::vector<glm::vec3>& rgb) const
{
    const int box = window_.box;
    const int width = window_.width / box;
    const float share = 1.0f / static_cast<float>(box * box);
    const float clipped = 1 - 0.5f / scale_.fullScale; // as in exposure_merge.cpp; minus infinity for floats
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0);
            glm::bvec3 isClipped(false);
            for (int step = 0; step < box * box; ++step) {
                const size_t row = static_cast<size_t>(y) * box + step / box;
                const float* value = &values_[(row * window_.fileWidth + window_.x + x * box + step % box) * channels];
                for (int c = 0; c < 3; ++c) {
                    sum[c] += value[channels == 3 ? c : 0];
                    isClipped[c] |= scale_.isInteger() && value[channels == 3 ? c : 0] >= clipped;
                }
            }
            for (int c = 0; c < 3; ++c) {
                rgb[static_cast<size_t>(y) * width + x][c] = isClipped[c] ? 1.0f : sum[c] * share;
            }
        }
    }
}

void ExposureFile::endBand()
{
    values_ = {};
    if (!keptOpen_) {
        rows_.reset();
    }
}

size_t openFileAllowance()
{
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    std::error_code ignored;
    const fs::directory_iterator openFiles("/proc/self/fd", ignored);
    const size_t taken = std::distance(begin(openFiles), end(openFiles)) + kSpareFiles;
    return limit.rlim_cur > taken ? limit.rlim_cur - taken : 0;
}

} // namespace nacre
