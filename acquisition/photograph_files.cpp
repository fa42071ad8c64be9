#include "acquisition/photograph_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "acquisition/progressive_pictures.h"
#include "engine/scene/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// For outputs, libraries and the files that threads open for a moment.
constexpr size_t kSpareFiles = 32;

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

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    std::string name = (parent / "nacre-photographs-XXXXXX").string();
    if (error || !mkdtemp(name.data())) {
        throw Error(name, fmt::format("cannot be made: {}", error ? error.message() : std::strerror(errno)),
                    "a writable folder for temporary files (TMPDIR)");
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

ExposureFile::ExposureFile(const Exposure& exposure, const Capture& capture)
    : file_(exposure.file), source_(exposure.file), curve_(capture.curve), seconds_(exposure.seconds),
      width_(capture.width), height_(capture.height)
{
}

ImageRows& ExposureFile::open()
{
    rows_.emplace(source_, curve_);
    const ImageHeader& header = rows_->header();
    if (header.width != width_ || header.height != height_) {
        throw Error(file_, fmt::format("is {} x {} now", header.width, header.height),
                    fmt::format("{} x {} as when the capture was loaded", width_, height_));
    }
    if (source_ == file_) {
        scale_ = exposureScaleOf(header.pixelType, seconds_);
    }
    return *rows_;
}

size_t ExposureFile::keepOpen()
{
    const ImageRows& rows = open();
    keptOpen_ = true;
    const bool streams = rows.streams() && !isProgressive(source_);
    return streams ? 0 : size_t{sizeof(float)} * width_ * height_ * rows.header().channels;
}

void ExposureFile::spill(const fs::path& copyWithoutExtension)
{
    // Undecoded, so that integers stay integers and the copy reads as the file did.
    rows_.emplace(file_, TransferCurve::linear);
    const std::string pixelType = rows_->header().pixelType;
    Image picture(width_, height_, rows_->channels());
    rows_->read(0, height_, picture.values);
    rows_.reset(); // the picture that it holds
    source_ = saveCopy(copyWithoutExtension, picture, pixelType);
    picture = {};
    keepOpen();
}

void ExposureFile::read(int first, int last, std::vector<glm::vec3>& rgb)
{
    ImageRows& rows = rows_ ? *rows_ : open();
    const size_t pixels = static_cast<size_t>(last - first) * width_;
    rgb.resize(pixels);
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

void ExposureFile::endBand()
{
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
