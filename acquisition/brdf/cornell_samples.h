#pragma once
#include <filesystem>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "acquisition/brdf/brdf_samples.h"
#include "shared/brdf_coords.h"

namespace nacre {

// Linear Rec. 709 of a reflectance spectrum under D65 by the CIE 1931 2 degree observer, over 400 to 700 nm in steps of
// 10 nm; a perfect reflector (1 at all wavelengths) is exactly (1,1,1). Colours outside of the gamut have negative
// channels. `wavelengths` in nm ascend and reach from 400 or less to 700 or more; between them the spectrum is linear.
glm::vec3 rec709FromReflectance(std::span<const float> wavelengths, std::span<const float> spectrum);

// A list of gonioreflectometer measurements of Cornell University's Program of Computer Graphics (`NAME.brdf`; Li, Foo,
// Torrance and Westin, Testing of a gonioreflectometer for computer graphics, 2005).
struct CornellMeasurements {
    std::string name;                  // the file's comments, without the first
    std::vector<float> wavelengths;    // nm
    std::vector<LightView> directions; // tangent frame
    std::vector<glm::vec3> values;     // f in 1/sr: linear Rec. 709 under D65 by the CIE 1931 observer, at least 0
    size_t clipped = 0;                // values with a channel below 0 (outside of Rec. 709), set to 0
};

// Text: `#` begins a comment; the number of wavelengths; the wavelengths in nm; then a line for each measurement:
// thetaI, phiI, thetaS, phiS in radians, both azimuths about the normal in one sense, and f in 1/sr at each wavelength.
// Throws Error that names the line.
CornellMeasurements loadCornellMeasurements(const std::filesystem::path& file);

// Those that `keep` wants of their index, at half-difference coordinates over the whole domain, weight 1.
template <class Keep> BrdfSamples samplesOf(const CornellMeasurements& measurements, Keep&& keep)
{
    BrdfSamples samples;
    samples.domain = {kHalfDifference, kHalfPi};
    for (size_t i = 0; i < measurements.values.size(); ++i) {
        if (keep(i)) {
            const LightView& d = measurements.directions[i];
            samples.unit.push_back(unitFromDirections(samples.domain, vec3(0, 0, 1), d.l, d.v));
            samples.values.push_back(measurements.values[i]);
            samples.weights.push_back(1);
        }
    }
    return samples;
}

// Four of five, by a hash of the index: what is interpolated where the fifth is to be predicted.
bool isKeptOfFive(size_t index);

} // namespace nacre
