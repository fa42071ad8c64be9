#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace nacre {

// Which of two crossing yarns lies on top: warp i (counted to the right) and weft j (upwards), repeating.
class WeavePattern {
public:
    // A float is a run of crossings that a yarn passes on one side without change.
    struct Float {
        int first = 0;     // crossing, relative to the one asked for: 0 or less
        int length = 1;    // crossings
        bool above = true; // the yarn that was asked for lies on top
    };

    // Names as in weaveNames(). Asserts that there is one.
    static WeavePattern named(const std::string& name);

    bool warpIsOnTop(int warp, int weft) const { return onTop_[place(warp) * repeat_ + place(weft)]; }
    const Float& warpFloat(int warp, int weft) const { return warpFloats_[place(warp) * repeat_ + place(weft)]; }
    const Float& weftFloat(int weft, int warp) const { return weftFloats_[place(weft) * repeat_ + place(warp)]; }

private:
    explicit WeavePattern(const std::vector<std::string>& rows);
    int place(int index) const { return (index % repeat_ + repeat_) % repeat_; }

    int repeat_;
    std::vector<uint8_t> onTop_;    // [warp * repeat + weft]
    std::vector<Float> warpFloats_; // [warp * repeat + weft]
    std::vector<Float> weftFloats_; // [weft * repeat + warp]
};

std::vector<std::string> weaveNames();

} // namespace nacre
