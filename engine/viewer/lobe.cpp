#include "engine/viewer/lobe.h"

#include <cmath>

#include "engine/scene/coverage.h"

namespace nacre {

std::vector<LobeSample> sampleLobe(const BrdfTable& table, float incidence, int count)
{
    const glm::vec3 n(0, 0, 1), l(-std::sin(incidence), 0, std::cos(incidence));
    std::vector<LobeSample> samples;
    for (int i = 0; i < count; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(count); // the horizons have no f
        const float angle = (2 * share - 1) * kHalfPi;
        const glm::vec3 v(std::sin(angle), 0, std::cos(angle));
        samples.push_back({angle, evaluateTable(table, n, l, v).value, !asksUnmeasured(table, n, l, v)});
    }
    return samples;
}

} // namespace nacre
