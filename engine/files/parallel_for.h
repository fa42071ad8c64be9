#pragma once
#include <cstddef>
#include <functional>

namespace nacre {

// Calls body(first, last) on consecutive chunks of [0, count), `grain` items each, from `threads` threads (0 = all of
// the machine's). Chunk borders do not depend on the number of threads, so results that are kept per item or per
// chunk are the same bytes for any of them. Of several exceptions the one of the
// first chunk is thrown again here, so that messages do not depend on the number of threads either.
void parallelFor(size_t count, size_t grain, int threads, const std::function<void(size_t, size_t)>& body);

} // namespace nacre
