#pragma once
#include <optional>
#include <span>
#include <vector>

#include "engine/rti/rti_picture.h"
#include "engine/scene/scene.h"

namespace nacre {

struct RtiFitOptions {
    int lights = 0;                     // white, of irradiance 1, one at a time
    std::optional<float> exposureStops; // without: the 99th percentile over all lights' pictures lies at 0.9
    int threads = 0;                    // 0 = all
};

// A surface as reflectance transformation images have it: fitted to its pictures for the eye, made by the renderer's
// formulas on the CPU.
class RtiFits {
public:
    RtiFits(Surface surface, std::span<const RtiBasis> bases, const RtiFitOptions& options);

    const RtiPicture& of(RtiBasis basis) const;
    const std::vector<glm::vec3>& lights() const { return lights_; }
    float exposureStops() const { return stops_; }

    // Of what a file shows against the surface under rtiCheckLights, which were not fitted, in dB over the object.
    double psnrOf(const RtiPicture& fromFile);

private:
    Image pictureUnder(const glm::vec3& light);

    Scene scene_;
    std::vector<glm::vec3> lights_;
    float stops_;
    int threads_;
    std::vector<RtiPicture> fits_;
};

} // namespace nacre
