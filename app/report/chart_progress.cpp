#include "app/report/chart_progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace nacre {

void ChartProgress::show(const std::string& what, size_t done) const
{
    if (quiet_) {
        return;
    }
    const double elapsed = watch_.seconds();
    const size_t left = all_ - std::min(all_, done);
    const std::string time =
        done == 0 ? ""
                  : fmt::format(", about {:.0f} s", elapsed * static_cast<double>(left) / static_cast<double>(done));
    const bool terminal = isatty(STDERR_FILENO);
    fmt::print(stderr, "{}{}; {} of {} settings left{}{}", terminal ? "\r\x1b[K" : "", what, left, all_, time,
               terminal ? "" : "\n");
    std::fflush(stderr);
}

void ChartProgress::end() const
{
    if (!quiet_ && isatty(STDERR_FILENO)) {
        fmt::print(stderr, "\r\x1b[K");
    }
}

} // namespace nacre
