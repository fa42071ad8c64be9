#pragma once
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace nacre {

struct StageTime {
    std::string stage;
    double seconds = 0;
};

// Wall-clock seconds per stage, in the order in which stages first ran.
class StageClock {
public:
    explicit StageClock(std::vector<StageTime>& times) : times_(times) {}

    template <class Work> auto time(const std::string& stage, Work&& work)
    {
        const auto start = std::chrono::steady_clock::now();
        struct AddOnExit {
            std::vector<StageTime>& times;
            std::string stage;
            std::chrono::steady_clock::time_point start;
            ~AddOnExit()
            {
                const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                const auto found =
                    std::find_if(times.begin(), times.end(), [&](const StageTime& t) { return t.stage == stage; });
                (found == times.end() ? times.emplace_back(StageTime{stage, 0}) : *found).seconds += seconds;
            }
        } add{times_, stage, start};
        return work();
    }

private:
    std::vector<StageTime>& times_;
};

} // namespace nacre
