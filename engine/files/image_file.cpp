// The only file that knows OpenImageIO.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/icc_profile.h"
#include "engine/files/image.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// gAMA holds 100000 times the exponent from light to code value: 1 is linear, 0.45 the usual display's, which stands
// for sRGB (PNG specification, 1996, 4.2.2.3).
constexpr uint32_t kGamaUnit = 100000, kDisplayGama = 45455, kDisplayGamaWidth = 1000;

uint32_t bigEndian(const unsigned char* bytes)
{
    return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

TransferCurve curveOfGama(uint32_t gama)
{
    if (gama == 0 || (gama > kDisplayGama - kDisplayGamaWidth && gama < kDisplayGama + kDisplayGamaWidth)) {
        return TransferCurve::srgb;
    }
    return powerCurve(static_cast<double>(kGamaUnit) / gama);
}

// What a PNG's own sRGB or gAMA chunk says of its curve; picture readers add a guess, which hides whether it does.
std::optional<TransferCurve> pngCurve(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(8); // signature
    std::optional<TransferCurve> curve;
    unsigned char head[8];
    while (stream.read(reinterpret_cast<char*>(head), sizeof head)) {
        const uint32_t length = bigEndian(head);
        const std::string type(reinterpret_cast<char*>(head) + 4, 4);
        if (type == "IDAT" || type == "IEND") {
            break;
        }
        if (type == "sRGB") {
            return TransferCurve::srgb;
        }
        if (type == "gAMA" && length == 4) {
            unsigned char gamma[4];
            stream.read(reinterpret_cast<char*>(gamma), sizeof gamma);
            curve = curveOfGama(bigEndian(gamma));
            stream.seekg(4, std::ios::cur);
        } else {
            stream.seekg(std::streamoff{length} + 4, std::ios::cur);
        }
    }
    return curve;
}

constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kTemporary = 0x01;

bool isRestart(int marker)
{
    return marker >= 0xd0 && marker <= 0xd7;
}

// The next marker at or after the position; what stands between 0xff bytes of coded data (0xff 0x00, restarts) and it
// is passed over. -1 at the file's end.
int nextMarker(std::streambuf& bytes)
{
    constexpr int kEnd = std::streambuf::traits_type::eof();
    int byte = bytes.sbumpc();
    while (byte != kEnd) {
        if (byte != 0xff) {
            byte = bytes.sbumpc();
            continue;
        }
        byte = bytes.sbumpc();
        if (byte != kEnd && byte != 0x00 && byte != 0xff && !isRestart(byte) && byte != kTemporary) {
            return byte;
        }
    }
    return -1;
}

// Whether a JPEG reaches its end-of-image marker (ITU-T T.81, 1992, B.1.1.3). libjpeg fills up a file that was cut off
// with grey and only warns, which OpenImageIO does not pass on. What follows the marker, as some cameras append, does
// not count. True for files that are no JPEG.
bool isCompleteJpeg(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::streambuf& bytes = *stream.rdbuf();
    if (bytes.sbumpc() != 0xff || bytes.sbumpc() != kStartOfImage) {
        return true;
    }
    for (int marker = nextMarker(bytes); marker >= 0; marker = nextMarker(bytes)) {
        if (marker == kEndOfImage) {
            return true;
        }
        const int high = bytes.sbumpc(), low = bytes.sbumpc(); // a segment's length, itself included
        const int length = high << 8 | low;
        if (high < 0 || low < 0 || length < 2) {
            return false;
        }
        stream.seekg(length - 2, std::ios::cur);
    }
    return false;
}

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

std::unique_ptr<OIIO::ImageInput> openInput(const fs::path& file)
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
    return input;
}

[[noreturn]] void throwUnreadable(const fs::path& file, const OIIO::ImageInput& input)
{
    throw Error(file, "cannot be read to its end: " + firstLine(input.geterror()), "a whole, undamaged picture");
}

// Positions of R, G, B, A among the file's channels (EXR lists them alphabetically), others behind in file order.
std::vector<int> channelOrder(const OIIO::ImageSpec& spec)
{
    std::vector<int> order;
    for (const char* name : {"R", "G", "B", "A"}) {
        const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
        if (found != spec.channelnames.end()) {
            order.push_back(static_cast<int>(found - spec.channelnames.begin()));
        }
    }
    for (int c = 0; c < spec.nchannels; ++c) {
        if (std::find(order.begin(), order.end(), c) == order.end()) {
            order.push_back(c);
        }
    }
    return order;
}

std::optional<IccColour> profileOf(const OIIO::ImageSpec& spec)
{
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    return profile ? readIccProfile(
                         {static_cast<const unsigned char*>(profile->data()), static_cast<size_t>(profile->datasize())})
                   : std::nullopt;
}

// Exif 2.32, ColorSpace: 1 is sRGB. Anything else is not linear either; cameras mean Adobe RGB by it.
constexpr int kExifSrgb = 1, kExifNone = 0;

void declareCurve(ImageHeader& header, const fs::path& file, const OIIO::ImageSpec& spec)
{
    const int exif = spec.get_int_attribute("Exif:ColorSpace", kExifNone);
    header.curveIsDeclared = true;
    if (const std::optional<IccColour> profile = profileOf(spec)) {
        header.curve = profile->curve;
        header.hasOtherPrimaries = profile->hasOtherPrimaries;
    } else if (const auto png = header.format == "png" ? pngCurve(file) : std::nullopt) {
        header.curve = *png;
    } else if (exif == kExifSrgb) {
        header.curve = TransferCurve::srgb;
    } else {
        header.curveIsDeclared = false;
        const bool isDisplayed = header.format == "jpeg" || exif != kExifNone || spec.find_attribute("ICCProfile");
        header.curve = isDisplayed && header.pixelType == "uint8" ? TransferCurve::srgb : TransferCurve::linear;
    }
}

bool sidewaysOrientation(int orientation)
{
    return orientation >= 5;
}

ImageHeader headerOf(const fs::path& file, const OIIO::ImageInput& input)
{
    const OIIO::ImageSpec& spec = input.spec();
    ImageHeader header;
    header.width = spec.width;
    header.height = spec.height;
    if (sidewaysOrientation(spec.get_int_attribute("Orientation", 1))) {
        std::swap(header.width, header.height);
    }
    header.channels = spec.nchannels;
    header.format = input.format_name();
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

// Whole picture as displayed, channels in file order.
std::vector<float> readUpright(const fs::path& file, OIIO::ImageInput& input)
{
    const OIIO::ImageSpec spec = input.spec();
    std::vector<float> values(spec.image_pixels() * spec.nchannels);
    if (!input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
        throwUnreadable(file, input);
    }
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation == 1) {
        return values;
    }
    OIIO::ImageSpec turnedSpec(spec.width, spec.height, spec.nchannels, OIIO::TypeDesc::FLOAT);
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
    return headerOf(file, *openInput(file));
}

struct ImageRows::Reader {
    fs::path file;
    TransferCurve curve;
    std::unique_ptr<OIIO::ImageInput> input;
    ImageHeader header;
    std::vector<int> order;
    int channels = 0;
    bool streams = false;
    int nextRow = 0;
    std::vector<float> held; // the upright picture, file order, where rows cannot be streamed
    std::vector<float> rows;
};

ImageRows::ImageRows(const fs::path& file, const TransferCurve& curve) : reader_(std::make_unique<Reader>())
{
    Reader& r = *reader_;
    r.file = file;
    r.curve = curve;
    r.input = openInput(file);
    r.header = headerOf(file, *r.input);
    const OIIO::ImageSpec& spec = r.input->spec();
    r.order = channelOrder(spec);
    r.channels = spec.nchannels >= 3 ? 3 : 1;
    const bool rowFormat = r.header.format == "png" || r.header.format == "jpeg" || r.header.format == "tiff" ||
                           r.header.format == "openexr";
    r.streams = rowFormat && spec.tile_width == 0 && spec.get_int_attribute("Orientation", 1) == 1;
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
    const int fileChannels = r.header.channels;
    const size_t rowValues = static_cast<size_t>(r.header.width) * fileChannels;
    if (first < r.nextRow || last > r.header.height) {
        throw std::logic_error("rows are read once, in ascending order");
    }
    r.nextRow = last;
    std::span<const float> source;
    if (r.streams) {
        r.rows.resize(rowValues * (last - first));
        const int top = r.input->spec().y;
        if (!r.input->read_scanlines(0, 0, top + first, top + last, 0, 0, fileChannels, OIIO::TypeDesc::FLOAT,
                                     r.rows.data())) {
            throwUnreadable(r.file, *r.input);
        }
        source = r.rows;
    } else {
        if (r.held.empty()) {
            r.held = readUpright(r.file, *r.input);
        }
        source = std::span(r.held).subspan(rowValues * first, rowValues * (last - first));
    }
    pickChannels(source, fileChannels, r.order, r.channels, out);
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
    const auto input = openInput(file);
    const ImageHeader header = headerOf(file, *input);
    Image image(header.width, header.height, header.channels);
    pickChannels(readUpright(file, *input), header.channels, channelOrder(input->spec()), header.channels,
                 image.values);
    return image;
}

std::string readImageAttribute(const fs::path& file, const std::string& name)
{
    return std::string(openInput(file)->spec().get_string_attribute(name));
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
