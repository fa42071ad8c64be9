#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/rti/rti_picture.h"

namespace nacre {

// An .rti as others write it, of hemispherical harmonics to the second order.
inline std::string hshBytes(const RtiPicture& picture)
{
    std::string bytes = fmt::format("#HSH1.2\r\n3\r\n{} {} 3\r\n9 2 1\r\n", picture.width(), picture.height());
    std::vector<float> scales, biases;
    for (const Image& term : picture.terms) {
        const auto [least, most] = std::minmax_element(term.values.begin(), term.values.end());
        scales.push_back(std::max(1e-6f, *most - *least));
        biases.push_back(*least);
    }
    for (const std::vector<float>* floats : {&scales, &biases}) {
        bytes.append(reinterpret_cast<const char*>(floats->data()), floats->size() * sizeof(float));
    }
    // By pixel and channel, and of each all terms: as values lie.
    for (size_t i = 0; i < picture.terms[0].values.size(); ++i) {
        for (size_t k = 0; k < picture.terms.size(); ++k) {
            bytes += static_cast<char>(std::lround(255 * (picture.terms[k].values[i] - biases[k]) / scales[k]));
        }
    }
    return bytes;
}

} // namespace nacre
