#include "engine/files/unfinished.h"

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include <unistd.h>

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
// Whoever ends a program often sends a signal to it and to its group: such two are one.
constexpr std::chrono::milliseconds kSameSignal(100);
constexpr int kRemovals = 20; // threads that are still writing add files to a folder that is being removed

struct Registry {
    std::mutex mutex;
    std::set<fs::path> paths;
};

// Never destroyed: the thread that waits for signals outlives main.
Registry& registry()
{
    static Registry& one = *new Registry;
    return one;
}

void removeAll(const fs::path& path)
{
    std::error_code error;
    for (int i = 0; i < kRemovals; ++i) {
        fs::remove_all(path, error);
        if (!error && !fs::exists(path, error)) {
            return;
        }
    }
}

[[noreturn]] void endBy(int signal)
{
    const std::unique_lock lock = holdUnfinished();
    for (const fs::path& path : registry().paths) {
        removeAll(path);
    }
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    raise(signal);
    _exit(128 + signal);
}

void forgetTwin(int signal)
{
    std::this_thread::sleep_for(kSameSignal);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    const timespec now{};
    sigtimedwait(&one, nullptr, &now);
}

void waitForSignals(sigset_t signals)
{
    int signal = 0;
    while (sigwait(&signals, &signal) == 0) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_DFL) {
            endBy(signal);
        }
        if (action.sa_handler != SIG_IGN) {
            action.sa_handler(signal);
            if (action.sa_flags & SA_RESETHAND) {
                std::signal(signal, SIG_DFL);
            }
            forgetTwin(signal);
        }
    }
}

} // namespace

Unfinished::Unfinished(fs::path path) : path_(std::move(path))
{
    const std::unique_lock lock = holdUnfinished();
    registry().paths.insert(path_);
}

Unfinished::~Unfinished()
{
    const std::unique_lock lock = holdUnfinished();
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    registry().paths.erase(path_);
}

std::unique_lock<std::mutex> holdUnfinished()
{
    return std::unique_lock(registry().mutex);
}

void removeUnfinishedOnSignals()
{
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kSignals) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_DFL) { // else nohup's wish
            sigaddset(&signals, signal);
        }
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(waitForSignals, signals).detach();
}

} // namespace nacre
