#pragma once
#include <filesystem>
#include <memory>

#include "engine/files/image.h"

namespace nacre {

// An animated WebP, lossless: what is read back are the codes that were added. Same frames, same bytes.
class AnimationFile {
public:
    static constexpr int kFrameMilliseconds = 40; // each; repeated for ever
    static constexpr int kLargestSide = 16383;    // of the format, in pixels

    // Throws Error where the format has no such size.
    AnimationFile(std::filesystem::path file, int width, int height);
    ~AnimationFile();
    AnimationFile(const AnimationFile&) = delete;
    AnimationFile& operator=(const AnimationFile&) = delete;

    // 3 channels, code values in [0,1], rounded to n/255.
    void add(const Image& picture);
    // Writes the file, whole or not at all, in place of what was there. Throws Error where the disk refuses.
    void write();

private:
    struct Encoder;

    std::filesystem::path file_;
    std::unique_ptr<Encoder> encoder_;
    int frames_ = 0;
};

} // namespace nacre
