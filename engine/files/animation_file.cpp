// The only file that knows libwebp.
#include "engine/files/animation_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace {

// 0 (fast) to 9 (small): beyond 2, renders shrink by a few percent for several times the time.
constexpr int kLosslessLevel = 2;

struct Picture {
    WebPPicture webp{};
    Picture() { WebPPictureInit(&webp); }
    ~Picture() { WebPPictureFree(&webp); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
};

struct Data {
    WebPData webp{};
    Data() { WebPDataInit(&webp); }
    ~Data() { WebPDataClear(&webp); }
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;
};

uint32_t opaqueArgb(const float* code)
{
    const auto byte = [](float value) {
        return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    };
    return 0xff000000u | byte(code[0]) << 16 | byte(code[1]) << 8 | byte(code[2]);
}

} // namespace

struct AnimationFile::Encoder {
    WebPAnimEncoder* animation = nullptr;
    WebPConfig config{};
    int width, height;

    Encoder(int w, int h) : width(w), height(h)
    {
        WebPAnimEncoderOptions options;
        bool ready = WebPAnimEncoderOptionsInit(&options) && WebPConfigInit(&config) &&
                     WebPConfigLosslessPreset(&config, kLosslessLevel);
        if (ready) {
            animation = WebPAnimEncoderNew(width, height, &options);
        }
        if (animation == nullptr) {
            throw Error({}, "libwebp cannot start an animation", "its headers' version, and memory");
        }
    }
    ~Encoder() { WebPAnimEncoderDelete(animation); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // frame is null at the end.
    void add(WebPPicture* frame, int milliseconds, const std::filesystem::path& file)
    {
        if (!WebPAnimEncoderAdd(animation, frame, milliseconds, frame ? &config : nullptr)) {
            throw Error(file, fmt::format("cannot be encoded: {}", WebPAnimEncoderGetError(animation)),
                        "pictures that libwebp takes, and memory for them");
        }
    }
};

AnimationFile::AnimationFile(std::filesystem::path file, int width, int height) : file_(std::move(file))
{
    if (width < 1 || height < 1 || std::max(width, height) > kLargestSide) {
        throw Error(file_, fmt::format("a WebP of {} x {} pixels does not exist", width, height),
                    fmt::format("1 to {} each way, or numbered .png", kLargestSide));
    }
    encoder_ = std::make_unique<Encoder>(width, height);
}

AnimationFile::~AnimationFile() = default;

void AnimationFile::add(const Image& picture)
{
    assert(picture.channels == 3 && picture.width == encoder_->width && picture.height == encoder_->height);
    Picture frame;
    frame.webp.use_argb = 1;
    frame.webp.width = picture.width;
    frame.webp.height = picture.height;
    if (!WebPPictureAlloc(&frame.webp)) {
        throw Error(file_, "needs more memory than there is", "smaller pictures");
    }
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            frame.webp.argb[y * frame.webp.argb_stride + x] = opaqueArgb(&picture.values[picture.index(x, y)]);
        }
    }
    encoder_->add(&frame.webp, frames_++ * kFrameMilliseconds, file_);
}

void AnimationFile::write()
{
    encoder_->add(nullptr, frames_ * kFrameMilliseconds, file_);
    Data data;
    if (!WebPAnimEncoderAssemble(encoder_->animation, &data.webp)) {
        throw Error(file_, fmt::format("cannot be assembled: {}", WebPAnimEncoderGetError(encoder_->animation)),
                    "at least one frame, and memory");
    }
    writeWholeFile(file_, std::span(data.webp.bytes, data.webp.size));
}

} // namespace nacre
