#include "evaluation/charts/gnuplot.h"

#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "evaluation/charts/html_page.h"

namespace nacre {

namespace {
namespace fs = std::filesystem;

// Colours are told apart by people who do not see red and green as two: Okabe, Ito, Color Universal Design, 2008.
constexpr const char* kHead = R"(set datafile separator comma
set datafile columnheaders
set datafile missing NaN
set key below Left reverse samplen 1 height 1
set grid lc rgb '#e6e6e6' lt 1
set tics nomirror out
set border 3

blue = '#0072b2'; orange = '#d55e00'; grey = '#b4b4b4'
shape(i) = int(word('7 5 9 13 11 15 3', (i - 1) % 7 + 1))

# Values written beside a logarithmic axis: the fewer decades, the more of each.
decades(least, most) = log10(most / least) < 0.6 ? 0.6 : log10(most / least)
marks(span) = span < 1.05 ? '1 1.5 2 3 4 5 6 7 8' : span < 2.6 ? '1 2 5' : '1'
short(v) = v >= 1e9 ? sprintf('%gG', v / 1e9) : v >= 1e6 ? sprintf('%gM', v / 1e6) : \
           v >= 1e3 ? sprintf('%gk', v / 1e3) : sprintf('%g', v)
)";

// Answers its exit status; 127 where there is no gnuplot. No shell comes between; what it says goes nowhere, as whoever
// runs the script again reads it.
int runGnuplot(const fs::path& folder, const std::string& script)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    }
    posix_spawnattr_t attributes; // a signal that the program holds back still ends gnuplot
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    std::string program = "gnuplot", defaults = "--default-settings", file = script;
    char* arguments[] = {program.data(), defaults.data(), file.data(), nullptr};
    pid_t child = 0;
    const int failure = posix_spawnp(&child, "gnuplot", &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (failure != 0) {
        return 127;
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

std::string quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? "''" : std::string(1, static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
    }
    return result + "'";
}

std::string plotHead(const std::string& name, const std::string& title, int width, int height)
{
    return fmt::format("# Draws {0}.svg; run `gnuplot {0}.gp` in this folder.\n"
                       "set terminal svg size {1},{2} noenhanced background '#ffffff' font 'sans-serif,12'\n"
                       "set output '{0}.svg'\nset title {3} font ',15'\n",
                       name, width, height, quoted(title)) +
           kHead;
}

std::string drawPlots(const fs::path& folder, const std::vector<Plot>& plots)
{
    std::string failed;
    for (const Plot& plot : plots) {
        const std::string script = plot.name + ".gp";
        writeTextFile(folder / script, plot.script);
        const int status = runGnuplot(folder, script);
        if (status == 127) {
            failed = "charts are not drawn: gnuplot is missing (Debian: gnuplot-nox); with it, `gnuplot *.gp` in the "
                     "output folder draws them";
        } else if (status != 0) {
            fs::remove(folder / (plot.name + ".svg"));
            failed = fmt::format("gnuplot cannot draw {} (exit status {})", script, status);
        }
    }
    return failed;
}

std::string plotFigure(const fs::path& folder, const Plot& plot)
{
    const fs::path picture = folder / (plot.name + ".svg");
    return fs::exists(picture) ? "<div class=\"wide chart\"><img alt=\"" + escaped(plot.name) + "\" src=\"" +
                                     dataUri(picture, "svg+xml") + "\"></div>\n"
                               : "";
}

} // namespace nacre
