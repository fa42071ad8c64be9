#include "acquisition/capture/json_photographs.h"

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "engine/files/strict_json.h"

namespace nacre {

namespace {

double secondsOf(const JsonNode& node)
{
    const double seconds = node.number();
    if (!(seconds > 0)) {
        throw node.error(fmt::format("is {}", seconds), "a positive time");
    }
    return seconds;
}

std::vector<Exposure> bracketOf(const JsonNode& node)
{
    std::vector<Exposure> exposures;
    for (const JsonNode& item : node.items()) {
        item.allowKeys({"file", "seconds"});
        exposures.push_back({item.at("file").existingPath(), secondsOf(item.at("seconds"))});
    }
    if (exposures.empty()) {
        throw node.error("is empty", "at least one exposure");
    }
    return exposures;
}

struct GivenPhotograph {
    Photograph photograph;
    bool exposureGiven;
};

GivenPhotograph readPhotograph(const JsonNode& node, bool lightsAllowed)
{
    if (node.isText()) {
        return {photographOf(node.existingPath()), false};
    }
    if (lightsAllowed) {
        node.allowKeys({"file", "exposureSeconds", "exposures", "light", "skip"});
    } else {
        node.allowKeys({"file", "exposureSeconds", "exposures"});
    }
    const auto skip = node.find("skip");
    if (const auto bracket = node.find("exposures")) {
        if (node.has("file") || node.has("exposureSeconds")) {
            throw node.error("has \"exposures\" beside a file or time of its own", "one of the two");
        }
        Photograph photograph{"", bracketOf(*bracket), skip && skip->truth()};
        photograph.name = photograph.exposures[0].file.filename().string();
        return {photograph, true};
    }
    GivenPhotograph given{photographOf(node.at("file").existingPath()), false};
    given.photograph.skip = skip && skip->truth();
    if (const auto seconds = node.find("exposureSeconds")) {
        given.photograph.exposures[0].seconds = secondsOf(*seconds);
        given.exposureGiven = true;
    }
    return given;
}

} // namespace

JsonPhotographs readPhotographs(const std::vector<JsonNode>& nodes, bool lightsAllowed)
{
    JsonPhotographs result;
    for (const JsonNode& node : nodes) {
        const GivenPhotograph given = readPhotograph(node, lightsAllowed);
        if (!result.photographs.empty() && given.exposureGiven != result.exposuresGiven) {
            throw node.error(
                fmt::format("{} an exposure time, unlike the first", given.exposureGiven ? "has" : "lacks"),
                "times for all photographs or for none");
        }
        result.exposuresGiven = given.exposureGiven;
        result.photographs.push_back(given.photograph);
    }
    return result;
}

} // namespace nacre
