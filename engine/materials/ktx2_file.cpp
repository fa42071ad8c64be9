#include "engine/materials/ktx2_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include <glm/gtc/packing.hpp>

#include "engine/files/whole_file.h"

namespace nacre {
namespace {

constexpr unsigned char kIdentifier[12] = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
constexpr uint32_t kVulkanFormat = 97; // VK_FORMAT_R16G16B16A16_SFLOAT
constexpr uint32_t kChannels = 4;
constexpr uint32_t kChannelBytes = 2;
constexpr uint32_t kTexelBytes = kChannels * kChannelBytes; // also the alignment of the levels
constexpr float kLargestKtxHalf = 65504.0f;
// Identifier, nine fields, index of the three blocks, and one level's entry.
constexpr uint32_t kHeaderBytes = 12 + 9 * 4 + 4 * 4 + 2 * 8 + 3 * 8;

using Bytes = std::vector<unsigned char>;

// Little-endian, as this machine is and the format asks.
template <class T> void append(Bytes& bytes, T value)
{
    const size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(&bytes[at], &value, sizeof(T));
}

void padTo(Bytes& bytes, size_t alignment)
{
    bytes.resize((bytes.size() + alignment - 1) / alignment * alignment);
}

// Khronos Data Format Specification 1.3, section 5, basic descriptor: what each bit of a texel means.
Bytes dataFormatDescriptor()
{
    constexpr uint32_t kBlockBytes = 24 + 16 * kChannels;
    constexpr uint8_t kModelRgbsda = 1, kPrimariesBt709 = 1, kTransferLinear = 1, kAlphaStraight = 0;
    constexpr uint8_t kChannelIds[kChannels] = {0, 1, 2, 15}; // red, green, blue, alpha
    constexpr uint8_t kFloat = 0x80, kSigned = 0x40;
    constexpr uint32_t kMinusOne = 0xBF800000u, kOne = 0x3F800000u; // as float32, the nominal range
    Bytes bytes;
    append<uint32_t>(bytes, 4 + kBlockBytes);
    append<uint32_t>(bytes, 0); // Khronos, basic format
    append<uint16_t>(bytes, 2); // version 1.3
    append<uint16_t>(bytes, kBlockBytes);
    for (uint8_t field : {kModelRgbsda, kPrimariesBt709, kTransferLinear, kAlphaStraight}) {
        append(bytes, field);
    }
    append<uint32_t>(bytes, 0); // texel block of 1x1x1x1
    append<uint64_t>(bytes, kTexelBytes);
    for (uint32_t channel = 0; channel < kChannels; ++channel) {
        append<uint16_t>(bytes, static_cast<uint16_t>(channel * 8 * kChannelBytes));
        append<uint8_t>(bytes, 8 * kChannelBytes - 1);
        append<uint8_t>(bytes, kChannelIds[channel] | kFloat | kSigned);
        append<uint32_t>(bytes, 0); // sample position
        append(bytes, kMinusOne);
        append(bytes, kOne);
    }
    return bytes;
}

// Keys in ascending order, as the specification asks.
Bytes keyValueData(const BrdfTable& table)
{
    const std::pair<std::string, std::string> entries[] = {{"KTXwriter", "nacre"},
                                                           {"nacre:brdfTable", describeShape(table)}};
    Bytes bytes;
    for (const auto& [key, value] : entries) {
        append<uint32_t>(bytes, static_cast<uint32_t>(key.size() + value.size() + 2)); // both end with a 0
        for (const std::string& text : {key, value}) {
            bytes.insert(bytes.end(), text.begin(), text.end());
            bytes.push_back(0);
        }
        padTo(bytes, 4);
    }
    return bytes;
}

Bytes texels(const BrdfTable& table, size_t& clamped)
{
    Bytes bytes(table.values.size() * kTexelBytes);
    for (size_t i = 0; i < table.values.size(); ++i) {
        const glm::vec4 texel(table.values[i], table.confidence[i]);
        for (uint32_t c = 0; c < kChannels; ++c) {
            clamped += std::abs(texel[c]) > kLargestKtxHalf;
            const uint16_t half = glm::packHalf1x16(std::clamp(texel[c], -kLargestKtxHalf, kLargestKtxHalf));
            std::memcpy(&bytes[i * kTexelBytes + c * kChannelBytes], &half, kChannelBytes);
        }
    }
    return bytes;
}

} // namespace

size_t saveKtx2(const std::filesystem::path& file, const BrdfTable& table)
{
    size_t clamped = 0;
    const Bytes descriptor = dataFormatDescriptor(), keys = keyValueData(table), level = texels(table, clamped);
    const auto descriptorBytes = static_cast<uint32_t>(descriptor.size()),
               keyBytes = static_cast<uint32_t>(keys.size());
    const uint64_t levelAt = (kHeaderBytes + descriptorBytes + keyBytes + kTexelBytes - 1) / kTexelBytes * kTexelBytes;
    Bytes bytes(std::begin(kIdentifier), std::end(kIdentifier));
    constexpr uint32_t kLayers = 0, kFaces = 1, kLevels = 1, kSupercompression = 0;
    for (uint32_t field :
         {kVulkanFormat, kChannelBytes, static_cast<uint32_t>(table.size.x), static_cast<uint32_t>(table.size.y),
          static_cast<uint32_t>(table.size.z), kLayers, kFaces, kLevels, kSupercompression}) {
        append(bytes, field);
    }
    for (uint32_t field : {kHeaderBytes, descriptorBytes, kHeaderBytes + descriptorBytes, keyBytes}) {
        append(bytes, field);
    }
    // Supercompression's global data, of which there is none; then the level.
    for (uint64_t field : {uint64_t{0}, uint64_t{0}, levelAt, uint64_t{level.size()}, uint64_t{level.size()}}) {
        append(bytes, field);
    }
    bytes.insert(bytes.end(), descriptor.begin(), descriptor.end());
    bytes.insert(bytes.end(), keys.begin(), keys.end());
    padTo(bytes, kTexelBytes);
    bytes.insert(bytes.end(), level.begin(), level.end());
    writeWholeFile(file, bytes);
    return clamped;
}

} // namespace nacre
