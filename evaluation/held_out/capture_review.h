#pragma once
#include <optional>
#include <string>
#include <vector>

#include "acquisition/chain/acquire.h"

namespace nacre {

struct ReviewedPhotograph {
    std::string name;
    Light light;
    Image thumbnail;                   // display values, cut to the object
    bool isGiven = false;              // whether the acquisition has seen it
    bool isDiscordant = false;         // left out, since the others contradict it
    double psnr = 0;                   // dB of the acquisition's prediction
    std::optional<double> heldOutPsnr; // of a second acquisition that has not seen it
};

struct CaptureReview {
    std::vector<ReviewedPhotograph> photographs;
    std::string heldOut; // how photographs were kept back, or why none could be
};

// Every photograph against what the acquisition made of it says. Where the acquisition was given all, a second one
// with the same options holds every seventh back. Reads one photograph at a time, twice. PSNR of radiance over the
// mask, peak: the 99th percentile of an even sample of all photographs' values.
CaptureReview reviewCapture(const Capture& capture, const AcquireOptions& options, const Acquisition& acquisition,
                            const Progress& progress);

// Area means of the part of the picture that holds the mask, at most `side` pixels wide and high.
Image thumbnailOf(const Image& picture, const Capture& capture, int side);

} // namespace nacre
