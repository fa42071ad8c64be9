#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace nacre {

// A small tensor file of our own with `azimuths`, and `colourName` for its last array.
inline std::string tensorFile(size_t azimuths, const std::string& colourName)
{
    struct Array {
        std::string name;
        std::vector<uint64_t> shape;
        uint8_t type;
    };
    const std::vector<Array> arrays{{"description", {3}, 1},
                                    {"jacobian", {1}, 1},
                                    {"phi_i", {azimuths}, 10},
                                    {"theta_i", {2}, 10},
                                    {"ndf", {2, 2}, 10},
                                    {"sigma", {2, 2}, 10},
                                    {"vndf", {azimuths, 2, 2, 2}, 10},
                                    {colourName, {azimuths, 2, 3, 2, 2}, 10}};
    std::string header("tensor_file\0\1\0", 14), data;
    const auto append = [&](auto value, std::string& to) {
        to.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    size_t headerBytes = 18;
    for (const Array& a : arrays) {
        headerBytes += 2 + a.name.size() + 2 + 1 + 8 + 8 * a.shape.size();
    }
    append(static_cast<uint32_t>(arrays.size()), header);
    for (const Array& a : arrays) {
        append(static_cast<uint16_t>(a.name.size()), header);
        header += a.name;
        append(static_cast<uint16_t>(a.shape.size()), header);
        append(a.type, header);
        append(static_cast<uint64_t>(headerBytes + data.size()), header);
        uint64_t count = 1;
        for (uint64_t n : a.shape) {
            append(n, header);
            count *= n;
        }
        for (uint64_t i = 0; i < count; ++i) {
            if (a.type == 1) {
                append(static_cast<uint8_t>(1), data);
            } else {
                append(a.name == "theta_i" || a.name == "phi_i" ? static_cast<float>(i) : 1.0f, data);
            }
        }
    }
    return header + data;
}

} // namespace nacre
