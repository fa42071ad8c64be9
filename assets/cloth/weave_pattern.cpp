#include "assets/cloth/weave_pattern.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace nacre {
namespace {

// Point papers: rows of weft, the uppermost last, # where the warp is on top. Satins are warp-faced, with a counter of
// 2 (five ends) and 3 (eight ends).
const std::vector<std::pair<std::string, std::vector<std::string>>>& pointPapers()
{
    static const std::vector<std::pair<std::string, std::vector<std::string>>> kPapers = {
        {"plain", {"#.", ".#"}},
        {"twill", {"##..", ".##.", "..##", "#..#"}},
        {"twill31", {"###.", ".###", "#.##", "##.#"}},
        {"satin5", {".####", "##.##", "####.", "#.###", "###.#"}},
        {"satin8", {".#######", "###.####", "######.#", "#.######", "####.###", "#######.", "##.#####", "#####.##"}},
    };
    return kPapers;
}

// The run of equal answers about 0; in every weave each yarn changes sides within the repeat.
WeavePattern::Float floatAbout(int repeat, const std::function<bool(int)>& above)
{
    WeavePattern::Float run{0, 1, above(0)};
    for (; above(run.first - 1) == run.above && run.length < repeat; ++run.length) {
        --run.first;
    }
    for (int next = 1; above(next) == run.above && run.length < repeat; ++next) {
        ++run.length;
    }
    return run;
}

} // namespace

WeavePattern::WeavePattern(const std::vector<std::string>& rows) : repeat_(static_cast<int>(rows.size()))
{
    for (int warp = 0; warp < repeat_; ++warp) {
        for (int weft = 0; weft < repeat_; ++weft) {
            onTop_.push_back(rows[weft][warp] == '#');
        }
    }
    for (int a = 0; a < repeat_; ++a) {
        for (int b = 0; b < repeat_; ++b) {
            warpFloats_.push_back(floatAbout(repeat_, [&](int step) { return warpIsOnTop(a, b + step); }));
            weftFloats_.push_back(floatAbout(repeat_, [&](int step) { return !warpIsOnTop(b + step, a); }));
        }
    }
}

WeavePattern WeavePattern::named(const std::string& name)
{
    const auto found = std::find_if(pointPapers().begin(), pointPapers().end(),
                                    [&](const auto& paper) { return paper.first == name; });
    assert(found != pointPapers().end());
    return WeavePattern(found->second);
}

std::vector<std::string> weaveNames()
{
    std::vector<std::string> names;
    for (const auto& paper : pointPapers()) {
        names.push_back(paper.first);
    }
    return names;
}

} // namespace nacre
