#include "evaluation/charts/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace nacre {

bool dominates(const Cost& a, const Cost& b)
{
    return a.x <= b.x && a.y <= b.y && (a.x < b.x || a.y < b.y);
}

std::vector<char> paretoFront(std::span<const Cost> costs)
{
    std::vector<char> front(costs.size(), 0);
    for (size_t i = 0; i < costs.size(); ++i) {
        const Cost& cost = costs[i];
        front[i] = !std::isnan(cost.x) && !std::isnan(cost.y) &&
                   std::none_of(costs.begin(), costs.end(), [&](const Cost& other) { return dominates(other, cost); });
    }
    return front;
}

} // namespace nacre
