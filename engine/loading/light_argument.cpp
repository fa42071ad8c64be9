#include "engine/loading/light_argument.h"

namespace nacre {

std::vector<Light> lightsFromArguments(const std::vector<std::string>& texts,
                                       const std::vector<CapturedLight>& captured)
{
    std::vector<LightSource> sources;
    for (const std::string& text : texts) {
        sources.push_back(lightSourceFromText(text));
    }
    if (texts.empty()) {
        sources.push_back(defaultLightSource(captured));
    }
    return lightsOf(sources, captured);
}

} // namespace nacre
