#include "engine/files/picture_parts.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/files/text_files.h"

namespace nacre {

namespace {

constexpr size_t kMostDescribed = 6;
constexpr size_t kColours = 3;
constexpr int kNone = -1;

std::string layerOf(const std::string& channel)
{
    return channel.substr(0, channel.find_last_of('.') + 1);
}

// Of a picture in colour: its depth is none of its channels.
bool isDepth(const std::string& channel)
{
    const std::string name = lowerCase(channel.substr(layerOf(channel).size()));
    return name == "z" || name == "zback" || name == "depth";
}

// Of one layer: where R, G, B and A are, and all others.
struct Layer {
    std::array<int, 4> rgba = {kNone, kNone, kNone, kNone};
    std::vector<int> others;

    bool hasColour() const
    {
        return std::find(rgba.begin(), rgba.begin() + kColours, kNone) == rgba.begin() + kColours;
    }

    void add(const std::string& name, int channel)
    {
        constexpr std::array<std::pair<const char*, const char*>, 4> kNames = {
            {{"r", "red"}, {"g", "green"}, {"b", "blue"}, {"a", "alpha"}}};
        const auto known = std::find_if(kNames.begin(), kNames.end(),
                                        [&](const auto& n) { return name == n.first || name == n.second; });
        if (known != kNames.end() && rgba[known - kNames.begin()] == kNone) {
            rgba[known - kNames.begin()] = channel;
        } else {
            others.push_back(channel);
        }
    }

    std::vector<int> ordered() const
    {
        std::vector<int> order;
        std::copy_if(rgba.begin(), rgba.end(), std::back_inserter(order), [](int c) { return c != kNone; });
        order.insert(order.end(), others.begin(), others.end());
        return order;
    }
};

std::map<std::string, Layer> layersOf(const PicturePart& part)
{
    std::map<std::string, Layer> layers;
    for (size_t c = 0; c < part.channels.size(); ++c) {
        const std::string layer = layerOf(part.channels[c]);
        layers[layer].add(lowerCase(part.channels[c].substr(layer.size())), static_cast<int>(c));
    }
    return layers;
}

// The layer without a name where it has colour, else the only one that has; empty otherwise.
std::vector<int> colourChannels(const PicturePart& part)
{
    std::map<std::string, Layer> layers = layersOf(part);
    std::erase_if(layers, [](const auto& entry) { return !entry.second.hasColour(); });
    if (layers.size() != 1 && !layers.contains("")) {
        return {};
    }
    std::vector<int> channels = layers.begin()->second.ordered();
    std::erase_if(channels, [&](int c) { return isDepth(part.channels[c]); });
    return channels;
}

// Of a part without colour, where it is one layer.
std::vector<int> plainChannels(const PicturePart& part)
{
    const std::map<std::string, Layer> layers = layersOf(part);
    return layers.size() == 1 ? layers.begin()->second.ordered() : std::vector<int>();
}

} // namespace

std::optional<ChosenPicture> choosePicture(const std::vector<PicturePart>& parts)
{
    const auto area = [](const PicturePart& part) { return int64_t{part.width} * part.height; };
    int64_t largest = 0;
    for (const PicturePart& part : parts) {
        largest = std::max(largest, area(part));
    }
    for (const auto channelsOf : {colourChannels, plainChannels}) {
        std::vector<ChosenPicture> found;
        for (size_t i = 0; i < parts.size(); ++i) {
            if (std::vector<int> channels = channelsOf(parts[i]); area(parts[i]) == largest && !channels.empty()) {
                found.push_back({i, std::move(channels)});
            }
        }
        if (!found.empty()) {
            return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
        }
    }
    return std::nullopt;
}

std::string describe(const std::vector<PicturePart>& parts)
{
    std::vector<std::string> texts;
    for (size_t i = 0; i < std::min(parts.size(), kMostDescribed); ++i) {
        const PicturePart& part = parts[i];
        texts.push_back(fmt::format("{} of {} x {} ({})",
                                    part.name.empty() ? fmt::format("picture {}", i + 1) : part.name, part.width,
                                    part.height, fmt::join(part.channels, ",")));
    }
    const size_t more = parts.size() - texts.size();
    return fmt::format("{}{}", fmt::join(texts, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

} // namespace nacre
