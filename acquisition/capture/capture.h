#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// One file of a photograph; the exposures of a bracket differ in time alone.
struct Exposure {
    std::filesystem::path file;
    double seconds = 1; // relative times will do, if they are so for the whole capture
};

// What the camera saw under one light.
struct Photograph {
    std::string name; // the file's name, for the user
    std::vector<Exposure> exposures;
    bool skip = false; // to be left out
};

// The part of the files' pixels that a capture has, in boxes of box x box that are averaged to one pixel.
struct FileWindow {
    int x = 0; // of the top left pixel
    int y = 0;
    int width = 0; // in pixels of the files; 0: all
    int height = 0;
    int box = 1;
    int fileWidth = 0; // 0: as the capture
    int fileHeight = 0;
};

// In image coordinates: pixels, x right, y down, the centre of the top left pixel at (0.5, 0.5).
struct Circle {
    double x = 0;
    double y = 0;
    double radius = 0;
};

// Where a calibration sphere stands in the object's own photographs.
struct SphereInPicture {
    int x = 0; // of the crop around it, in pixels of the files
    int y = 0;
    int width = 0;
    int height = 0;
    std::filesystem::path mask; // white on the sphere, of the files' size or the crop's; empty: its outline is found
};

// X,Y,W,H, for messages.
std::string rectangleOf(const SphereInPicture& sphere);

// Photographs of a calibration sphere, one per light in the capture's order; its outline as a mask, a circle or a
// crop in which it is to be found.
struct SpherePhotographs {
    std::filesystem::path source; // what the user named, for messages
    std::vector<Photograph> photographs;
    std::filesystem::path maskFile; // empty where the circle is given
    std::optional<Circle> circle;
    std::optional<SphereInPicture> inPicture;
    std::vector<SphereInPicture> beside; // further ones in the same pictures
};

inline constexpr double kWidestView = 120; // degrees: what a pixel shows is far from a plane beyond it

enum class CaptureLayout { uw, diligent, rti, json, pictures };
std::string describe(CaptureLayout layout);

// N photographs of one still object from one still camera, on one common radiance scale. Pictures stay in their files.
struct Capture {
    std::string name;
    std::filesystem::path folder;
    CaptureLayout layout = CaptureLayout::json;
    int width = 0; // of the window
    int height = 0;
    FileWindow window;
    std::vector<Photograph> photographs;
    std::vector<std::string> skipped; // names of photographs that were left out with their lights
    std::vector<Light> lights;        // one per photograph; empty where they have to be calibrated
    bool irradianceGiven = false;     // false: lights have directions alone, irradiance 1
    std::string lightsSource;         // file that gave them, for the user
    std::string lightsOrder;   // how they were matched to photographs, for the user; empty where they come with them
    std::vector<uint8_t> mask; // width x height, 1 on the object
    size_t maskPixels = 0;
    std::string maskSource;      // for the user; empty where there is none, and all is the object
    std::vector<uint8_t> smooth; // 1 where normals are not to be estimated but smoothed in; empty where nowhere
    std::optional<SpherePhotographs> mirrorSphere;
    std::optional<SpherePhotographs> diffuseSphere;
    TransferCurve curve = TransferCurve::linear;
    std::string curveSource;            // e.g. "assumed", "declared by 001.png", "chosen"
    bool curveIsAssumed = false;        // neither files of 8 bits nor the user tell it
    float offset = 0;                   // subtracted from every value, spheres' too, before anything else is done to it
    std::string offsetSource;           // empty where none was asked for
    std::optional<Photograph> ambient;  // without the lights; subtracted from every photograph of the object
    std::filesystem::path truthNormals; // empty where there is none; of the files' size, see windowedNormals
    std::filesystem::path labelsFile;   // of the files' size; empty where there is none
    std::filesystem::path smoothFile;   // the same
    // In widths of the object, which is the longer side of its mask's bounding box, from the middle of that.
    std::optional<double> lightDistance;       // of all lights; infinite: they are distant; none: not known
    std::vector<glm::vec3> lightPlaces;        // one per photograph, camera frame; empty where they are not known
    std::optional<double> fieldOfView;         // across the files' width, degrees; none: the camera is orthographic
    std::optional<double> pixelsPerMillimetre; // of the files, in the object's plane
    std::optional<double> viewByExif;          // the same as the files' EXIF has it; stated, not used
};

// An offset to subtract, on the scale of decoded values in [0, 1], or to estimate.
struct OffsetChoice {
    bool automatic = false;
    float value = 0;
};

// What the command line adds to, or puts in place of, what the folder says. Empty: the folder's own.
struct CaptureOptions {
    std::optional<TransferCurve> transfer;
    std::filesystem::path mask;
    std::filesystem::path smooth;       // picture that is white where normals are to be smoothed in
    std::filesystem::path mirrorSphere; // folder of photographs and a mask, or in-picture:X,Y,W,H[,MASK]
    std::vector<std::filesystem::path> moreMirrorSpheres; // in-picture:X,Y,W,H[,MASK], beside one of these
    std::optional<Circle> circle;                         // the mirror sphere's outline, in pixels of its files
    std::filesystem::path diffuseSphere;
    std::filesystem::path ambient; // photograph without the lights
    FileWindow window;             // 0 wide: the folder's own
    std::vector<std::string> skip; // names of photographs, with or without extension
    std::optional<OffsetChoice> offset;
    std::optional<double> lightDistance; // in widths of the object; infinite: distant, whatever the photographs tell
    std::optional<double> objectWidth;   // in the unit in which a file places the lights
    std::optional<double> fieldOfView;   // degrees across the files' width
    std::optional<double> pixelsPerMillimetre;
    std::filesystem::path rig; // lights from another file, as loadLightFile reads them
    bool needsLights = false;  // a capture that says nothing of its lights is refused
};

// Finds out the layout (docs/formats.md) and checks all that can be checked without decoding every photograph:
// files are there and readable, sizes agree, counts agree, the mask is not empty. An offset to be estimated costs
// reading the photographs once. Throws Error.
Capture loadCapture(const std::filesystem::path& folder, const CaptureOptions& options = {});

// The parts of a capture that belong to the photographs named; the spheres' photographs go with those of the object.
Capture selectPhotographs(const Capture& capture, const std::vector<size_t>& chosen);

// The items named, in order; empty stays empty, as lists that a capture does not have.
template <class Item> std::vector<Item> selectItems(const std::vector<Item>& items, const std::vector<size_t>& chosen)
{
    std::vector<Item> result;
    for (size_t i = 0; i < chosen.size() && !items.empty(); ++i) {
        result.push_back(items[chosen[i]]);
    }
    return result;
}

} // namespace nacre
