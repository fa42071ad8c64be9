#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/files/transfer_curve.h"
#include "shared/tone.h"

namespace nacre {

// width x height x channels floats, row 0 on top, channels interleaved; linear Rec. 709 unless a field says otherwise.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;

    Image() = default;
    Image(int w, int h, int c, float fill = 0.0f)
        : width(w), height(h), channels(c), values(static_cast<size_t>(w) * h * c, fill)
    {
    }
    size_t pixelCount() const { return static_cast<size_t>(width) * height; }
    size_t index(int x, int y) const { return (static_cast<size_t>(y) * width + x) * channels; }
    float& at(int x, int y, int c = 0) { return values[index(x, y) + c]; }
    float at(int x, int y, int c = 0) const { return values[index(x, y) + c]; }
    // Grey pictures answer the same value in all three.
    glm::vec3 rgb(int x, int y) const
    {
        const float* p = &values[index(x, y)];
        return channels >= 3 ? glm::vec3(p[0], p[1], p[2]) : glm::vec3(p[0]);
    }
    void setRgb(int x, int y, const glm::vec3& v)
    {
        float* p = &values[index(x, y)];
        p[0] = v.x, p[1] = v.y, p[2] = v.z;
    }
};

// What a file says of itself.
struct ImageHeader {
    int width = 0; // as displayed, after EXIF orientation
    int height = 0;
    int orientation = 1; // EXIF: how the stored pixels are turned to be displayed
    int channels = 0;
    std::string format;    // OpenImageIO's name of it, e.g. "png"
    std::string pixelType; // e.g. "uint16", "float"
    // What an explicit sRGB or gAMA chunk, ICC profile or EXIF tag in the file says. Where none does (a reader's own
    // guess does not count), what is assumed: sRGB for JPEGs of 8 bits, which cameras write so, else linear.
    TransferCurve curve = TransferCurve::linear;
    bool curveIsDeclared = false;
    std::string otherColours;              // for the user, where they are not sRGB's: they are the file's all the same
    std::optional<double> exposureSeconds; // EXIF
    std::optional<double> filmFocalLength; // EXIF: in mm, of the lens that would show as much on 35 mm film
};

// Of several pictures in a file that in colour and full size is read, where it stands in its display window; pixels
// that the file lacks there are black. Throws Error (data) where the file is missing, no reader takes it, or its
// pictures leave a choice.
ImageHeader readImageHeader(const std::filesystem::path& file);

// Reads rows in ascending order, so that many large photographs can be walked side by side. Integers are divided by
// their full scale, floats are as they are; sRGB is decoded where asked; grey and RGB keep their channels, alpha is
// dropped. Formats whose readers hold the whole picture are held here too.
class ImageRows {
public:
    ImageRows(const std::filesystem::path& file, const TransferCurve& curve);
    ~ImageRows();
    ImageRows(ImageRows&&) noexcept;
    ImageRows& operator=(ImageRows&&) noexcept;

    const ImageHeader& header() const;
    int channels() const; // 1 or 3
    // Rows [first, last) to out, (last - first) x width x channels(). Rows before the last call's end throw.
    void read(int first, int last, std::span<float> out);
    // True where rows come from the file as asked for, false where the whole picture had to be held.
    bool streams() const;

private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

// A photograph's picture: 1 or 3 channels, linear after `curve`. Throws Error on unreadable files and NaN values.
Image loadPhotograph(const std::filesystem::path& file, const TransferCurve& curve);

// Any picture with the numbers as stored (integers divided by their full scale), all channels, in R, G, B, A order for
// EXR, where files are alphabetical.
Image loadImage(const std::filesystem::path& file);

// A text field for the file's metadata, e.g. {"Software", "nacre 1.0"}.
struct ImageAttribute {
    std::string name;
    std::string value;
};

enum class PixelType { uint8, uint16, half, float32 };

// The extension chooses the format. Values are stored as they are (no curve); integer types clamp to [0, 1] and round.
// Whole or not at all: written under a temporary name, then renamed. Throws Error where the disk refuses.
void saveImage(const std::filesystem::path& file, const Image& image, PixelType type,
               const std::vector<ImageAttribute>& attributes = {});

// Draws one line in white on an RGB picture, its baseline's left end at (x, y), letters `height` pixels high. False
// where no font is installed, and the picture is as it was.
bool drawText(Image& image, int x, int y, const std::string& text, int height);

// The named text attribute, empty where there is none.
std::string readImageAttribute(const std::filesystem::path& file, const std::string& name);

// How linear radiance becomes a picture.
struct Display {
    float exposureStops = 0; // radiance times 2^this
    int toneCurve = kToneSrgb;
    bool operator==(const Display&) const = default;
};

// Code values in [0,1] before they are rounded; 3 channels.
Image displayCodes(const Image& radiance, const Display& display);

// 8-bit code values in [0,1], rounded to n/255; 3 channels. The twin of shaders/display.frag.
Image displayedImage(const Image& radiance, const Display& display);

// Stops that put the peak (measures.h) of what is not black at 0.9.
float automaticExposure(const Image& radiance);

} // namespace nacre
