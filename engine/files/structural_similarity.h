#pragma once
#include <cstdint>
#include <span>

#include "engine/files/image.h"

namespace nacre {

// Mean structural similarity of pictures whose values are codes in [0,1]: Wang, Bovik, Sheikh, Simoncelli, Image
// Quality Assessment: From Error Visibility to Structural Similarity, 2004, Eq. 13 with K1 = 0.01, K2 = 0.03, Gaussian
// windows of 11x11 pixels, sigma 1.5. It is the mean over the pixels' windows and over red, green and blue: luma alone
// would not see two colours exchanged. 1 where the pictures are equal, towards 0 and below where they have nothing in
// common. Windows at the border are cut off and their weights made to add up to 1 (the authors' code leaves them out).
double structuralSimilarity(const Image& a, const Image& b);

// Over the windows whose middle is in the mask (mask[i] != 0); they see their neighbours outside too. NaN where the
// mask is empty.
double structuralSimilarity(const Image& a, const Image& b, std::span<const uint8_t> mask);

} // namespace nacre
