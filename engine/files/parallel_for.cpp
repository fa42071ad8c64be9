#include "engine/files/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace nacre {

void parallelFor(size_t count, size_t grain, int threads, const std::function<void(size_t, size_t)>& body)
{
    grain = std::max<size_t>(grain, 1);
    const size_t chunks = (count + grain - 1) / grain;
    const size_t wanted =
        threads > 0 ? static_cast<size_t>(threads) : std::max(1u, std::thread::hardware_concurrency());
    const size_t workers = std::min(wanted, chunks);
    if (workers <= 1) {
        for (size_t first = 0; first < count; first += grain) {
            body(first, std::min(count, first + grain));
        }
        return;
    }
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    size_t failedChunk = chunks;
    auto work = [&] {
        for (size_t chunk = next++; chunk < chunks; chunk = next++) {
            try {
                body(chunk * grain, std::min(count, (chunk + 1) * grain));
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (chunk < failedChunk) {
                    failedChunk = chunk;
                    failure = std::current_exception();
                }
                next = chunks;
            }
        }
    };
    std::vector<std::jthread> pool;
    for (size_t i = 1; i < workers; ++i) {
        pool.emplace_back(work);
    }
    work();
    pool.clear();
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace nacre
