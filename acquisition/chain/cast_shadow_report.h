#pragma once
#include <string>

namespace nacre {

// Shadows are worth a height where they predict lights left out better by this margin.
inline constexpr double kShadowMargin = 0.1; // dB

struct CastShadowReport {
    std::string whyNot;      // where none were looked for, or there are next to none
    double castShare = 0;    // of observations that face their light, in a shadow that something else casts
    bool areKept = false;    // judged where whyNot is empty
    double psnr = 0;         // dB of radiance under the lights left out, their mean, without shadows
    double shadowedPsnr = 0; // and with them
};

} // namespace nacre
