#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nacre {

// The container of the RGL material database (Dupuy and Jakob, An Adaptive Parameterization for Efficient Material
// Acquisition and Rendering, 2018): named arrays of any dimension, little-endian, the last index running fastest.
struct Tensor {
    std::vector<uint64_t> shape;
    std::vector<float> numbers; // of float32 arrays
    std::string bytes;          // of uint8 arrays

    size_t size() const;
};

// The arrays of float32 and uint8 by name; others are left out. Throws Error where the file is cut short, is no tensor
// file, or has an array that lies outside of it.
std::map<std::string, Tensor> loadTensorFile(const std::filesystem::path& file);

} // namespace nacre
