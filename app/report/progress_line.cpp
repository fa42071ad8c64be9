#include "app/report/progress_line.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace nacre {

namespace {

bool isShown(bool quiet)
{
    return !quiet && isatty(STDERR_FILENO);
}

} // namespace

Progress progressLine(bool quiet)
{
    if (!isShown(quiet)) {
        return [](const std::string&, double) {};
    }
    return [](const std::string& stage, double share) {
        fmt::print(stderr, "\r\x1b[K{} {:.0f} %", stage, 100 * share);
        std::fflush(stderr);
    };
}

void endProgressLine(bool quiet)
{
    if (isShown(quiet)) {
        fmt::print(stderr, "\r\x1b[K");
    }
}

} // namespace nacre
