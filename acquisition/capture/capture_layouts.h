#pragma once
// Inside of loadCapture: what each layout reads, before picture headers are looked at.
#include <filesystem>
#include <optional>
#include <vector>

#include "acquisition/capture/capture.h"
#include "engine/lights/light_files.h"

namespace nacre {

struct LayoutContents {
    Capture capture;                          // without size, mask and curve
    std::filesystem::path listing;            // where the photographs are listed, for messages
    std::vector<std::filesystem::path> masks; // candidates; more than one is ambiguous
    std::optional<TransferCurve> transfer;
    bool exposuresGiven = false;
    std::optional<OffsetChoice> offset;
    std::optional<double> objectWidth; // in the unit of the vectors towards the lights, which are then their places
};

// Each answers nothing where the folder has another layout, and throws Error where it has this one, but wrongly.
std::optional<LayoutContents> readJsonLayout(const std::filesystem::path& file);
std::optional<LayoutContents> readDiligentLayout(const std::filesystem::path& folder);
std::optional<LayoutContents> readUwLayout(const std::filesystem::path& folder);
// `folder` may be its .lp; `rig` chooses among several.
std::optional<LayoutContents> readRtiLayout(const std::filesystem::path& folder, const std::filesystem::path& rig);

// A folder of a sphere's photographs with its mask: UW names, or pictures of any names in natural order.
std::optional<LayoutContents> readPlainFolder(const std::filesystem::path& folder);
SpherePhotographs readSphereFolder(const std::filesystem::path& folder, const std::optional<Circle>& outline = {});

// A photograph of one file and unknown exposure.
Photograph photographOf(const std::filesystem::path& file);

// Puts lights in place of what the capture has: by the names of photographs where the file names them as the capture
// does, otherwise in order. Throws Error where the counts differ.
void assignLights(LayoutContents& contents, const LightFile& lights, const std::filesystem::path& file);

// The light of each photograph where the file names photographs as the capture does; empty where it names none of
// them, as a rig that was calibrated with other photographs, or where names repeat. Throws Error where it names some.
std::vector<size_t> lightsByName(const LightFile& lights, const std::vector<Photograph>& photographs,
                                 const std::filesystem::path& file);

// Irradiances from a file with one for each of the lights. Throws Error where the counts differ.
void addIrradiances(LightFile& lights, const std::filesystem::path& file);

// Leaves out the photographs named, and puts the rig's lights, if any, in place of the capture's: those of all
// photographs, or of those that are not left out.
void skipAndAssignRig(LayoutContents& contents, const std::vector<std::string>& skip,
                      const std::optional<LightFile>& rig, const std::filesystem::path& file);

// Makes places, in widths of the object, of the vectors that the lights came with where that unit is known, and drops
// them elsewhere. Throws Error (data) where they are no places.
void placeLights(LayoutContents& contents, const CaptureOptions& options);

// in-picture:X,Y,W,H[,MASK], a sphere in the object's own photographs, or a folder of photographs and a mask. A
// sphere's mask beside the photographs is not the object's. Throws Error (usage) by the sphere's `name` where it is
// neither. Its outline may be given.
SpherePhotographs namedSphere(const std::string& name, const std::filesystem::path& specification,
                              LayoutContents& contents, const std::optional<Circle>& outline = {});

// A further mirror sphere in pictures that show one. Throws Error (usage) where either is not in the picture.
void addMirrorSphere(const std::filesystem::path& specification, LayoutContents& contents);

// The checks that need picture headers alone: sizes, one transfer curve, EXIF exposure times. Fills size and curve.
void examineHeaders(LayoutContents& contents, const std::optional<TransferCurve>& chosen);

// Sets the offset that is given, or estimates it, which reads every photograph once.
void applyOffset(Capture& capture, const OffsetChoice& choice);

} // namespace nacre
