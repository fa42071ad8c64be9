#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "assets/synth/target.h"

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

// A weave seen from the front. Lengths are in yarn spacings where nothing else is said.
struct WovenClothOptions {
    std::string weave = "plain"; // weaveNames()
    int threads = 32;            // yarns across the picture's shorter side, in either direction
    double curl = 0.5;           // tangent of the yarns' twist angle, 0 = fibres lie straight
    double drape = 0.35;         // slope of the long folds, rise over run; 0 = flat
    double wander = 1;           // irregularity of yarns: how far they stray and swell; 0 = a machine's drawing
    uint64_t seed = 1;
};

// Parts: warp (upright), weft.
Target wovenCloth(int width, int height, const WovenClothOptions& options = {}, int threads = 0);

} // namespace nacre
