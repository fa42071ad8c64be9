#include "app/arguments/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nacre {

namespace {

// Levenshtein's distance, row by row.
size_t lettersBetween(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = std::exchange(row[0], i + 1);
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t changed = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string nearestName(const std::string& typed, const std::vector<std::string>& names)
{
    std::string nearest;
    size_t least = std::min<size_t>(2, typed.size() / 3) + 1;
    for (const std::string& name : names) {
        const size_t letters = lettersBetween(typed, name);
        if (letters < least) {
            nearest = name;
            least = letters;
        }
    }
    return nearest;
}

} // namespace nacre
