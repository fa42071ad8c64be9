#include "assets/synth/sensor.h"

#include <algorithm>

#include "assets/synth/hash_random.h"

namespace nacre {

Image exposed(const Image& radiance, const Sensor& sensor, double seconds, uint64_t photograph)
{
    Image picture = radiance;
    const uint64_t stream = hashOf(sensor.seed, photograph);
    for (size_t i = 0; i < picture.values.size(); ++i) {
        double value = radiance.values[i] * sensor.gain * seconds;
        if (sensor.noise > 0.0) {
            value += sensor.noise * gaussianFromHash(hashOf(stream, i));
        }
        picture.values[i] = static_cast<float>(sensor.clips ? std::clamp(value, 0.0, 1.0) : value);
    }
    return picture;
}

} // namespace nacre
