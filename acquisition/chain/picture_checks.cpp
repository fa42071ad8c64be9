#include "acquisition/chain/picture_checks.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "acquisition/checks/camera_shake.h"
#include "acquisition/checks/mask_outline.h"
#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr size_t kOutlinePhotographs = 6;
constexpr size_t kShakenPhotographs = 24;
constexpr int kSmallSide = 400; // pixels, of the picture in which an outline is looked for

struct FewPhotographs {
    Capture capture;
    std::vector<Light> lights;
};

FewPhotographs fewOf(const Capture& capture, const PreparedCapture& prepared, size_t count)
{
    std::vector<glm::vec3> directions;
    std::vector<size_t> all;
    for (const Light& light : prepared.rig.lights) {
        all.push_back(directions.size());
        directions.push_back(light.direction);
    }
    const std::vector<size_t> chosen = farthestFirst(directions, all, std::min(count, all.size()));
    return {selectPhotographs(capture, selectItems(prepared.given, chosen)), selectLights(prepared.rig.lights, chosen)};
}

// In one block. None where values around the object are not finite, which only those on it have to be.
std::optional<Observations> readAll(Capture capture, std::vector<uint8_t> mask, int threads)
{
    capture.maskPixels = static_cast<size_t>(std::count(mask.begin(), mask.end(), uint8_t{1}));
    capture.mask = std::move(mask);
    try {
        ObservationReader reader(capture, threads, std::numeric_limits<size_t>::max() / 2);
        Observations seen;
        reader.next(seen);
        return seen;
    } catch (const Error&) {
        return std::nullopt;
    }
}

// The middle pixel of each box of box x box pixels.
std::vector<uint8_t> reduced(const Capture& capture, int box, int width, int height)
{
    std::vector<uint8_t> small;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int row = y * box + box / 2, column = x * box + box / 2;
            small.push_back(capture.mask[static_cast<size_t>(row) * capture.width + column]);
        }
    }
    return small;
}

SelfChecks checkOutline(const Capture& capture, const PreparedCapture& prepared)
{
    if (capture.maskSource.empty()) {
        return {};
    }
    auto [few, lights] = fewOf(capture, prepared, kOutlinePhotographs);
    const int box = std::max(1, std::max(few.width, few.height) / kSmallSide);
    FileWindow& window = few.window;
    if (window.fileWidth == 0) {
        window = {0, 0, few.width, few.height, 1, few.width, few.height};
    }
    few.width /= box;
    few.height /= box;
    window.box *= box;
    window.width = few.width * window.box;
    window.height = few.height * window.box;
    std::vector<uint8_t> all(static_cast<size_t>(few.width) * few.height, 1);
    const std::optional<Observations> seen = readAll(few, std::move(all), prepared.threads);
    return seen ? checkMaskOutline(*seen, reduced(capture, box, few.width, few.height)) : SelfChecks{};
}

SelfChecks checkMovement(const Capture& capture, const PreparedCapture& prepared)
{
    const ShakeTiles tiles = shakeTiles(capture.mask, capture.width, capture.height);
    if (tiles.corners.empty()) {
        return {};
    }
    auto [few, lights] = fewOf(capture, prepared, kShakenPhotographs);
    const std::optional<Observations> seen = readAll(few, tiles.mask(capture.width, capture.height), prepared.threads);
    return seen ? checkShake(*seen, tiles, lights, prepared.threads) : SelfChecks{};
}

} // namespace

SelfChecks checkPicture(const Capture& capture, const PreparedCapture& prepared)
{
    SelfChecks checks = checkOutline(capture, prepared);
    checks.add(checkMovement(capture, prepared));
    return checks;
}

} // namespace nacre
