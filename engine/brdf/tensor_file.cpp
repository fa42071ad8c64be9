#include "engine/brdf/tensor_file.h"

#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace {

constexpr const char kMagic[12] = "tensor_file"; // with the 0 that ends it
constexpr uint8_t kUint8 = 1;                    // the format's codes of element types
constexpr uint8_t kFloat32 = 10;
constexpr uint32_t kMostArrays = 1000;
constexpr uint16_t kMostDimensions = 16;

// Walks the header; what lies beyond the end is an error of the file.
class Cursor {
public:
    Cursor(const std::filesystem::path& file, const std::string& bytes) : file_(file), bytes_(bytes) {}

    template <class T> T read()
    {
        T value;
        std::memcpy(&value, text(sizeof(T)), sizeof(T));
        return value;
    }
    const char* text(size_t count)
    {
        if (bytes_.size() - at_ < count) {
            throw Error(file_, "ends within its header", "a whole tensor file");
        }
        at_ += count;
        return bytes_.data() + at_ - count;
    }

private:
    const std::filesystem::path& file_;
    const std::string& bytes_;
    size_t at_ = 0;
};

// Elements of `shape`, or more than any file holds where the product does not fit.
uint64_t elementCount(const std::vector<uint64_t>& shape)
{
    uint64_t count = 1;
    for (uint64_t n : shape) {
        if (n != 0 && count > std::numeric_limits<uint64_t>::max() / 16 / n) {
            return std::numeric_limits<uint64_t>::max() / 16;
        }
        count *= n;
    }
    return count;
}

Tensor readArray(const std::filesystem::path& file, const std::string& name, const std::string& bytes, uint8_t type,
                 uint64_t offset, std::vector<uint64_t> shape)
{
    const uint64_t length = elementCount(shape) * (type == kFloat32 ? sizeof(float) : 1);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        throw Error(file, fmt::format("is cut short: '{}' ends at byte {} of {}", name, offset + length, bytes.size()),
                    "a whole tensor file");
    }
    Tensor tensor{std::move(shape), {}, {}};
    if (type == kFloat32) {
        tensor.numbers.resize(length / sizeof(float));
        std::memcpy(tensor.numbers.data(), bytes.data() + offset, length);
    } else {
        tensor.bytes = bytes.substr(offset, length);
    }
    return tensor;
}

} // namespace

size_t Tensor::size() const
{
    return numbers.size() + bytes.size();
}

std::map<std::string, Tensor> loadTensorFile(const std::filesystem::path& file)
{
    const std::string bytes = readWholeFile(file, "a .bsdf of the RGL material database");
    Cursor cursor(file, bytes);
    if (bytes.size() < sizeof(kMagic) || std::memcmp(cursor.text(sizeof(kMagic)), kMagic, sizeof(kMagic)) != 0) {
        throw Error(file, "is no tensor file", "a .bsdf of the RGL material database");
    }
    const auto major = cursor.read<uint8_t>(), minor = cursor.read<uint8_t>();
    const auto count = cursor.read<uint32_t>();
    if (major != 1 || minor != 0 || count > kMostArrays) {
        throw Error(file, fmt::format("has version {}.{} and {} arrays", major, minor, count), "version 1.0");
    }
    std::map<std::string, Tensor> tensors;
    for (uint32_t i = 0; i < count; ++i) {
        const auto nameLength = cursor.read<uint16_t>();
        const std::string name(cursor.text(nameLength), nameLength);
        const auto dimensions = cursor.read<uint16_t>();
        const auto type = cursor.read<uint8_t>();
        const auto offset = cursor.read<uint64_t>();
        if (dimensions > kMostDimensions) {
            throw Error(file, fmt::format("gives '{}' {} dimensions", name, dimensions), "a tensor file");
        }
        std::vector<uint64_t> shape;
        for (int d = 0; d < dimensions; ++d) {
            shape.push_back(cursor.read<uint64_t>());
        }
        if (type == kFloat32 || type == kUint8) {
            tensors[name] = readArray(file, name, bytes, type, offset, std::move(shape));
        }
    }
    return tensors;
}

} // namespace nacre
