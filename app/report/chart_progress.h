#pragma once
#include <string>

#include "engine/files/stopwatch.h"

namespace nacre {

// On stderr: what is tried and what is left, its time by the mean of the settings that are done. One line that
// overwrites itself on a terminal, lines elsewhere.
class ChartProgress {
public:
    ChartProgress(size_t all, bool quiet) : all_(all), quiet_(quiet) {}

    void show(const std::string& what, size_t done) const;
    void end() const; // clears the line, if there is one

private:
    Stopwatch watch_;
    size_t all_;
    bool quiet_;
};

} // namespace nacre
