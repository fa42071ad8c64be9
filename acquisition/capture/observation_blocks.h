#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "acquisition/capture/observations.h"

namespace nacre {

// Observations block by block, as often as asked: of a capture's files, or of memory. A capture that is one block is
// read once and held; a larger one is read again in every walk.
class ObservationBlocks {
public:
    ObservationBlocks(Capture capture, int threads, size_t byteBudget);
    explicit ObservationBlocks(std::vector<Observations> blocks);

    // The next block, which lives until the next call; null at the end of a walk, after which another one begins.
    // Throws Error as ObservationReader does.
    const Observations* next();

    // From now on the capture's blocks hold these of its lights alone.
    void keepLights(const std::vector<size_t>& lights);

    // From now on what reaches it is clipped, by channel.
    void clipAt(const glm::vec3& end);

    // The capture, where there is one.
    const Capture& capture() const { return *capture_; }

private:
    std::shared_ptr<const Capture> capture_; // stays in its place when this moves
    int threads_ = 0;
    size_t byteBudget_ = 0;
    std::vector<size_t> lights_; // empty: all
    std::optional<glm::vec3> end_;
    std::optional<ObservationReader> reader_;
    Observations block_;             // the one last read
    std::vector<Observations> held_; // empty: to be read
    size_t place_ = 0;               // of the next held one
};

} // namespace nacre
