#pragma once
#include <vector>

#include "acquisition/capture/capture.h"

namespace nacre {

class JsonNode;

struct JsonPhotographs {
    std::vector<Photograph> photographs;
    bool exposuresGiven = false;
};

// The entries of a "photographs" array: a file's name, an object with "file" and perhaps "exposureSeconds", or one
// with "exposures"; "light" and "skip" are known keys where lights are allowed. Times are given for all or for none.
JsonPhotographs readPhotographs(const std::vector<JsonNode>& nodes, bool lightsAllowed);

} // namespace nacre
