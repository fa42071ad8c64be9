// The only file that knows OpenImageIO.
#include <algorithm>
#include <cmath>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/icc_profile.h"
#include "engine/files/image.h"
#include "engine/files/picture_bytes.h"
#include "engine/files/picture_parts.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kReadable = "a picture that OpenImageIO reads (TGA, PNG, JPEG, TIFF, EXR, camera raw, ...)";

// Colours as stored (not multiplied by alpha), raw files developed to linear light.
OIIO::ImageSpec readingHints()
{
    static const bool oneThread = [] {
        OIIO::attribute("threads", 1); // pictures are read side by side by parallelFor
        OIIO::attribute("exr_threads", -1);
        return true;
    }();
    (void)oneThread;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    hints.attribute("raw:ColorSpace", "Linear");
    return hints;
}

std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

[[noreturn]] void throwUnreadable(const fs::path& file, const OIIO::ImageInput& input)
{
    throw Error(file, "cannot be read to its end: " + firstLine(input.geterror()), "a whole, undamaged picture");
}

// Where a format places its pixels in a picture of another size. A PNG's offset tells no size of the whole.
OIIO::ROI pictureWindow(const OIIO::ImageInput& input)
{
    const std::string_view format = input.format_name();
    const bool isPlaced = format == "openexr" || format == "tiff";
    return isPlaced ? input.spec().roi_full() : input.spec().roi();
}

PicturePart partOf(const OIIO::ImageInput& input)
{
    const OIIO::ROI window = pictureWindow(input);
    return {std::string(input.spec().get_string_attribute("oiio:subimagename")), window.width(), window.height(),
            input.spec().channelnames};
}

// The other parts of these are layers of the first, or thumbnails.
bool isWholeInFirst(const OIIO::ImageInput& input)
{
    const std::string_view format = input.format_name();
    return format == "psd" || format == "heif";
}

// Inks and Lab are no amounts of light, whatever a reader makes of them.
void requireLight(const fs::path& file, const OIIO::ImageSpec& spec)
{
    for (const char* key : {"tiff:ColorSpace", "jpeg:ColorSpace"}) {
        const std::string space(spec.get_string_attribute(key));
        if (space.starts_with("CMYK") || space == "YCbCrK" || space.ends_with("LAB")) {
            throw Error(file, "is in " + space, "RGB or grey");
        }
    }
}

constexpr int64_t kMostPixels = int64_t{1} << 30; // more is damage

// A file's one picture, open where it begins.
struct OpenPicture {
    std::unique_ptr<OIIO::ImageInput> input;
    std::vector<int> channels; // of the file's, R, G, B, A first

    const OIIO::ImageSpec& spec() const { return input->spec(); }
};

OpenPicture openPicture(const fs::path& file)
{
    if (!fs::exists(file)) {
        throw Error(file, "does not exist", "a picture");
    }
    const OIIO::ImageSpec hints = readingHints();
    auto input = OIIO::ImageInput::open(file.string(), &hints);
    if (!input) {
        throw Error(file, "cannot be read: " + firstLine(OIIO::geterror()), kReadable);
    }
    if (std::string_view(input->format_name()) == "jpeg" && !isCompleteJpeg(file)) {
        throw Error(file, "is cut off before its end", "a whole, undamaged picture");
    }
    std::vector<PicturePart> parts = {partOf(*input)};
    for (int i = 1; !isWholeInFirst(*input) && input->seek_subimage(i, 0); ++i) {
        parts.push_back(partOf(*input));
    }
    input->geterror(); // there is no further part
    const std::optional<ChosenPicture> chosen = choosePicture(parts);
    if (!chosen) {
        throw Error(file, "holds several pictures: " + describe(parts), "one in colour and full size");
    }
    if (!input->seek_subimage(static_cast<int>(chosen->part), 0)) {
        throwUnreadable(file, *input);
    }
    requireLight(file, input->spec());
    const PicturePart& part = parts[chosen->part];
    if (int64_t{part.width} * part.height > kMostPixels) {
        throw Error(file, fmt::format("says that it is {} x {}", part.width, part.height),
                    fmt::format("{} pixels at most", kMostPixels));
    }
    return {std::move(input), chosen->channels};
}

std::optional<IccColour> profileOf(const OIIO::ImageSpec& spec)
{
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    return profile ? readIccProfile(
                         {static_cast<const unsigned char*>(profile->data()), static_cast<size_t>(profile->datasize())})
                   : std::nullopt;
}

// Exif 2.32, ColorSpace: 1 is sRGB. Anything else is not linear either.
constexpr int kExifSrgb = 1, kExifNone = 0;
constexpr const char* kOtherPrimaries = "its primaries are not those of sRGB, colours stay its own";
constexpr const char* kOtherByExif = "EXIF states a colour space other than sRGB, most often Adobe RGB, whose curve is "
                                     "nearly this one; colours stay its own";

void declareCurve(ImageHeader& header, const fs::path& file, const OIIO::ImageSpec& spec)
{
    const int exif = spec.get_int_attribute("Exif:ColorSpace", kExifNone);
    header.curveIsDeclared = true;
    if (const std::optional<IccColour> profile = profileOf(spec)) {
        header.curve = profile->curve;
        header.otherColours = profile->hasOtherPrimaries ? kOtherPrimaries : "";
    } else if (const auto png = header.format == "png" ? pngCurve(file) : std::nullopt) {
        header.curve = *png;
    } else if (exif == kExifSrgb) {
        header.curve = TransferCurve::srgb;
    } else if (header.format == "jpeg" && statesAdobeRgb(file)) {
        header.curve = adobeRgbCurve();
        header.otherColours = kOtherPrimaries;
    } else {
        header.curveIsDeclared = false;
        header.otherColours = exif != kExifNone ? kOtherByExif : "";
        const bool isDisplayed = header.format == "jpeg" || exif != kExifNone || spec.find_attribute("ICCProfile");
        header.curve = isDisplayed && header.pixelType == "uint8" ? TransferCurve::srgb : TransferCurve::linear;
    }
}

bool sidewaysOrientation(int orientation)
{
    return orientation >= 5;
}

ImageHeader headerOf(const fs::path& file, const OpenPicture& picture)
{
    const OIIO::ImageSpec& spec = picture.spec();
    const OIIO::ROI window = pictureWindow(*picture.input);
    ImageHeader header;
    header.width = window.width();
    header.height = window.height();
    header.orientation = spec.get_int_attribute("Orientation", 1);
    if (sidewaysOrientation(header.orientation)) {
        std::swap(header.width, header.height);
    }
    header.channels = static_cast<int>(picture.channels.size());
    header.format = picture.input->format_name();
    header.pixelType = spec.format.c_str();
    const float seconds = spec.get_float_attribute("ExposureTime", 0.0f);
    if (seconds > 0) {
        header.exposureSeconds = seconds;
    }
    const int focalLength = spec.get_int_attribute("Exif:FocalLengthIn35mmFilm", 0); // 0: not known
    if (focalLength > 0) {
        header.filmFocalLength = focalLength;
    }
    declareCurve(header, file, spec);
    return header;
}

// Pixels of `from` to where they stand in `to`; rows interleaved, windows in one frame.
void placePixels(const OIIO::ROI& from, std::span<const float> pixels, const OIIO::ROI& to, int channels,
                 std::span<float> out)
{
    const OIIO::ROI both = OIIO::roi_intersection(from, to);
    const auto at = [&](const OIIO::ROI& window, int y) {
        return (size_t{1} * (y - window.ybegin) * window.width() + (both.xbegin - window.xbegin)) * channels;
    };
    for (int y = both.ybegin; y < both.yend; ++y) {
        std::copy_n(&pixels[at(from, y)], static_cast<size_t>(both.width()) * channels, &out[at(to, y)]);
    }
}

// Rows of the window as stored, all of the file's channels; black where the file has no pixels.
std::vector<float> readRows(const fs::path& file, OIIO::ImageInput& input, OIIO::ROI window)
{
    const OIIO::ImageSpec& spec = input.spec();
    const int channels = spec.nchannels, part = input.current_subimage();
    const OIIO::ROI whole = spec.roi();
    OIIO::ROI data = whole;
    data.ybegin = std::clamp(window.ybegin, whole.ybegin, whole.yend);
    data.yend = std::clamp(window.yend, data.ybegin, whole.yend);
    std::vector<float> values(static_cast<size_t>(data.width()) * data.height() * channels);
    const bool isWhole = data.height() == whole.height();
    const auto float32 = OIIO::TypeDesc::FLOAT;
    const bool isRead = values.empty() || (isWhole ? input.read_image(part, 0, 0, channels, float32, values.data())
                                                   : input.read_scanlines(part, 0, data.ybegin, data.yend, 0, 0,
                                                                          channels, float32, values.data()));
    if (!isRead) {
        throwUnreadable(file, input);
    }
    if (data == window) {
        return values;
    }
    std::vector<float> placed(static_cast<size_t>(window.width()) * window.height() * channels);
    placePixels(data, values, window, channels, placed);
    return placed;
}

// Whole picture as displayed, the file's channels.
std::vector<float> readUpright(const fs::path& file, OIIO::ImageInput& input)
{
    const OIIO::ROI window = pictureWindow(input);
    std::vector<float> values = readRows(file, input, window);
    const int orientation = input.spec().get_int_attribute("Orientation", 1);
    if (orientation == 1) {
        return values;
    }
    OIIO::ImageSpec turnedSpec(window.width(), window.height(), input.spec().nchannels, OIIO::TypeDesc::FLOAT);
    turnedSpec.attribute("Orientation", orientation);
    const OIIO::ImageBuf stored(turnedSpec, values.data());
    const OIIO::ImageBuf upright = OIIO::ImageBufAlgo::reorient(stored);
    if (!upright.get_pixels(upright.roi(), OIIO::TypeDesc::FLOAT, values.data())) {
        throw Error(file, "cannot be turned upright: " + upright.geterror(), "an EXIF orientation from 1 to 8");
    }
    return values;
}

// From interleaved pixels of order.size() or more channels to the first `channels` of `order`.
void pickChannels(std::span<const float> from, int fromChannels, const std::vector<int>& order, int channels,
                  std::span<float> to)
{
    const size_t pixels = to.size() / channels;
    for (size_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < channels; ++c) {
            to[i * channels + c] = from[i * fromChannels + order[c]];
        }
    }
}

} // namespace

ImageHeader readImageHeader(const fs::path& file)
{
    return headerOf(file, openPicture(file));
}

struct ImageRows::Reader {
    fs::path file;
    TransferCurve curve;
    OpenPicture picture;
    ImageHeader header;
    int channels = 0;
    bool streams = false;
    int nextRow = 0;
    std::vector<float> held; // the upright picture, file order, where rows cannot be streamed
};

ImageRows::ImageRows(const fs::path& file, const TransferCurve& curve) : reader_(std::make_unique<Reader>())
{
    Reader& r = *reader_;
    r.file = file;
    r.curve = curve;
    r.picture = openPicture(file);
    r.header = headerOf(file, r.picture);
    r.channels = r.header.channels >= 3 ? 3 : 1;
    const bool rowFormat = r.header.format == "png" || r.header.format == "jpeg" || r.header.format == "tiff" ||
                           r.header.format == "openexr";
    r.streams = rowFormat && r.picture.spec().tile_width == 0 && r.header.orientation == 1;
}

ImageRows::~ImageRows() = default;
ImageRows::ImageRows(ImageRows&&) noexcept = default;
ImageRows& ImageRows::operator=(ImageRows&&) noexcept = default;

const ImageHeader& ImageRows::header() const
{
    return reader_->header;
}

int ImageRows::channels() const
{
    return reader_->channels;
}

bool ImageRows::streams() const
{
    return reader_->streams;
}

void ImageRows::read(int first, int last, std::span<float> out)
{
    Reader& r = *reader_;
    const int fileChannels = r.picture.spec().nchannels;
    const size_t rowValues = static_cast<size_t>(r.header.width) * fileChannels;
    if (first < r.nextRow || last > r.header.height) {
        throw std::logic_error("rows are read once, in ascending order");
    }
    r.nextRow = last;
    if (r.streams) {
        OIIO::ROI band = pictureWindow(*r.picture.input);
        band.yend = band.ybegin + last;
        band.ybegin += first;
        pickChannels(readRows(r.file, *r.picture.input, band), fileChannels, r.picture.channels, r.channels, out);
    } else {
        if (r.held.empty()) {
            r.held = readUpright(r.file, *r.picture.input);
        }
        pickChannels(std::span(r.held).subspan(rowValues * first, rowValues * (last - first)), fileChannels,
                     r.picture.channels, r.channels, out);
    }
    decodeCurve(out, r.curve);
}

Image loadPhotograph(const fs::path& file, const TransferCurve& curve)
{
    ImageRows rows(file, curve);
    Image image(rows.header().width, rows.header().height, rows.channels());
    rows.read(0, image.height, image.values);
    const auto bad = std::find_if(image.values.begin(), image.values.end(), [](float v) { return !std::isfinite(v); });
    if (bad != image.values.end()) {
        const size_t pixel = (bad - image.values.begin()) / image.channels;
        throw Error(
            file,
            fmt::format("has a value that is no number at pixel {}, {}", pixel % image.width, pixel / image.width),
            "finite values");
    }
    return image;
}

Image loadImage(const fs::path& file)
{
    const OpenPicture picture = openPicture(file);
    const ImageHeader header = headerOf(file, picture);
    Image image(header.width, header.height, header.channels);
    pickChannels(readUpright(file, *picture.input), picture.spec().nchannels, picture.channels, header.channels,
                 image.values);
    return image;
}

std::string readImageAttribute(const fs::path& file, const std::string& name)
{
    return std::string(openPicture(file).spec().get_string_attribute(name));
}

namespace {

OIIO::TypeDesc oiioType(PixelType type)
{
    switch (type) {
    case PixelType::uint8:
        return OIIO::TypeDesc::UINT8;
    case PixelType::uint16:
        return OIIO::TypeDesc::UINT16;
    case PixelType::half:
        return OIIO::TypeDesc::HALF;
    case PixelType::float32:
        break;
    }
    return OIIO::TypeDesc::FLOAT;
}

// 8-bit pictures are for display and tagged sRGB; all others hold linear values and say so. Not in TIFF, whose writer
// makes of the tag an EXIF directory that its reader refuses.
OIIO::ImageSpec specOf(const fs::path& file, const Image& image, PixelType type,
                       const std::vector<ImageAttribute>& attributes)
{
    OIIO::ImageSpec spec(image.width, image.height, image.channels, oiioType(type));
    if (lowerExtension(file) != ".tif" && lowerExtension(file) != ".tiff") {
        spec.attribute("oiio:ColorSpace", type == PixelType::uint8 ? "sRGB" : "Linear");
    }
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("DateTime", ""); // the EXR writer would put the time here: same input, same bytes
    for (const ImageAttribute& attribute : attributes) {
        spec.attribute(attribute.name, attribute.value);
    }
    return spec;
}

} // namespace

void saveImage(const fs::path& file, const Image& image, PixelType type, const std::vector<ImageAttribute>& attributes)
{
    auto writer = OIIO::ImageOutput::create(file.string());
    if (!writer || !writer->supports("ioproxy")) {
        throw Error(file, "its extension names no picture format that can be written", ".png, .exr, .tif or .jpg");
    }
    // Encoded in memory, since a full disk is not noticed by every format's writer.
    OIIO::Filesystem::IOVecOutput memory;
    writer->set_ioproxy(&memory);
    const bool encoded = writer->open(file.string(), specOf(file, image, type, attributes)) &&
                         writer->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) && writer->close();
    if (!encoded) {
        throw Error(file, "cannot be encoded: " + firstLine(writer->geterror()),
                    "a size and type that its format allows");
    }
    writeWholeFile(file, memory.buffer());
}

bool drawText(Image& image, int x, int y, const std::string& text, int height)
{
    OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT), image.values.data());
    const float white[] = {1, 1, 1};
    for (const char* font : {"DejaVuSans", ""}) {
        if (OIIO::ImageBufAlgo::render_text(buffer, x, y, text, height, font, white)) {
            return true;
        }
    }
    return false;
}

} // namespace nacre
