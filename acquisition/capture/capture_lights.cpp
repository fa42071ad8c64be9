// Which photographs count, which light each has, and the calibration spheres that the user names.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/capture/capture_layouts.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "in-picture:";

bool isNamed(const Photograph& photograph, const std::string& name)
{
    const std::string own = lowerCase(photograph.name);
    return lowerCase(name) == own || lowerCase(name) == fs::path(own).stem().string();
}

void markSkipped(std::vector<Photograph>& photographs, const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        size_t found = 0;
        for (Photograph& photograph : photographs) {
            if (isNamed(photograph, name)) {
                photograph.skip = true;
                ++found;
            }
        }
        if (found != 1) {
            throw Error("", fmt::format("{} names {} photographs to leave out", name, found),
                        fmt::format("one, such as {}", photographs[0].name), Error::kUsage);
        }
    }
}

void dropSkipped(Capture& capture)
{
    std::vector<size_t> kept;
    for (size_t i = 0; i < capture.photographs.size(); ++i) {
        if (capture.photographs[i].skip) {
            capture.skipped.push_back(capture.photographs[i].name);
        } else {
            kept.push_back(i);
        }
    }
    capture = selectPhotographs(capture, kept);
}

// Names agree without folders, which may be another machine's, extension and case.
std::string comparedName(std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    return comparable(fs::path(name).stem().string());
}

std::optional<SphereInPicture> sphereInPicture(const std::string& name, const fs::path& specification)
{
    const std::string& text = specification.native();
    if (!text.starts_with(kPrefix)) {
        return std::nullopt;
    }
    SphereInPicture sphere;
    const char* at = text.data() + kPrefix.size();
    const char* const end = text.data() + text.size();
    bool understood = true;
    for (int* number : {&sphere.x, &sphere.y, &sphere.width, &sphere.height}) {
        if (number != &sphere.x) {
            understood = understood && at != end && *at++ == ',';
        }
        const auto [next, problem] = std::from_chars(at, end, *number);
        understood =
            understood && problem == std::errc() && *number >= (number == &sphere.x || number == &sphere.y ? 0 : 1);
        at = next;
    }
    if (understood && at != end && *at == ',') {
        sphere.mask = std::string(at + 1, end);
        at = end;
        understood = !sphere.mask.empty();
    }
    if (!understood || at != end) {
        throw Error("", fmt::format("{} {} is not understood", name, text),
                    "in-picture:X,Y,W,H in whole pixels of the photographs, and a mask after a comma if you like",
                    Error::kUsage);
    }
    return sphere;
}

// A sphere of which every photograph of the object is one.
SpherePhotographs photographsOfSphere(const SphereInPicture& sphere, const Capture& capture)
{
    SpherePhotographs photographs;
    photographs.source = fmt::format("the sphere in the picture at {}", rectangleOf(sphere));
    photographs.photographs = capture.photographs;
    photographs.inPicture = sphere;
    return photographs;
}

} // namespace

Capture selectPhotographs(const Capture& capture, const std::vector<size_t>& chosen)
{
    Capture result = capture;
    result.photographs = selectItems(capture.photographs, chosen);
    result.lights = selectItems(capture.lights, chosen);
    result.lightPlaces = selectItems(capture.lightPlaces, chosen);
    for (std::optional<SpherePhotographs>* sphere : {&result.mirrorSphere, &result.diffuseSphere}) {
        if (*sphere) {
            (*sphere)->photographs = selectItems((*sphere)->photographs, chosen);
        }
    }
    return result;
}

std::vector<size_t> lightsByName(const LightFile& lights, const std::vector<Photograph>& photographs,
                                 const fs::path& file)
{
    std::map<std::string, size_t> lightOf;
    for (size_t i = 0; i < lights.photographs.size(); ++i) {
        lightOf.emplace(comparedName(lights.photographs[i]), i);
    }
    std::vector<size_t> order;
    const Photograph* unnamed = nullptr;
    for (const Photograph& photograph : photographs) {
        const auto named = lightOf.find(comparedName(photograph.name));
        if (named != lightOf.end()) {
            order.push_back(named->second);
        } else if (!unnamed) {
            unnamed = &photograph;
        }
    }
    const bool repeated = std::set(order.begin(), order.end()).size() != order.size();
    if (repeated || lightOf.size() != lights.photographs.size()) {
        return {};
    }
    if (unnamed && !order.empty()) {
        throw Error(
            file,
            fmt::format("names {} of {} photographs, but not {}", order.size(), photographs.size(), unnamed->name),
            "a light for each photograph");
    }
    return order;
}

void assignLights(LayoutContents& contents, const LightFile& lights, const fs::path& file)
{
    Capture& capture = contents.capture;
    if (lights.lights.size() != capture.photographs.size()) {
        throw Error(file,
                    fmt::format("has {} lights, {} has {} photographs", lights.lights.size(), contents.listing.string(),
                                capture.photographs.size()),
                    "one light for each photograph");
    }
    std::vector<size_t> order = lightsByName(lights, capture.photographs, file);
    capture.lightsOrder = order.empty() ? "matched to the photographs by order" : "matched to the photographs by name";
    if (order.empty()) {
        order.resize(lights.lights.size());
        std::iota(order.begin(), order.end(), size_t{0});
    }
    capture.lights = selectItems(lights.lights, order);
    capture.lightPlaces = selectItems(lights.vectors, order);
    capture.lightsSource = file.string();
    capture.irradianceGiven = lights.irradianceGiven;
}

void addIrradiances(LightFile& lights, const fs::path& file)
{
    const std::vector<glm::vec3> irradiances = loadIrradiances(file);
    if (irradiances.size() != lights.lights.size()) {
        throw Error(file,
                    fmt::format("has {} lights, there are {} directions", irradiances.size(), lights.lights.size()),
                    "as many");
    }
    for (size_t i = 0; i < irradiances.size(); ++i) {
        lights.lights[i].irradiance = irradiances[i];
    }
    lights.irradianceGiven = true;
}

void skipAndAssignRig(LayoutContents& contents, const std::vector<std::string>& skip,
                      const std::optional<LightFile>& rig, const fs::path& file)
{
    markSkipped(contents.capture.photographs, skip);
    const bool hasAll = rig && rig->lights.size() == contents.capture.photographs.size();
    if (hasAll) {
        assignLights(contents, *rig, file);
    }
    dropSkipped(contents.capture);
    if (rig && !hasAll) {
        assignLights(contents, *rig, file);
    }
}

namespace {

// Unit vectors are directions: lengths that differ by less.
constexpr float kSameLength = 0.01f;

bool areDirections(const std::vector<glm::vec3>& vectors)
{
    return std::all_of(vectors.begin(), vectors.end(),
                       [](const glm::vec3& v) { return std::abs(glm::length(v) - 1) < kSameLength; });
}

} // namespace

void placeLights(LayoutContents& contents, const CaptureOptions& options)
{
    Capture& capture = contents.capture;
    const std::optional<double> width = options.objectWidth ? options.objectWidth : contents.objectWidth;
    const std::optional<double> distance = options.lightDistance ? options.lightDistance : capture.lightDistance;
    std::vector<glm::vec3> vectors = std::move(capture.lightPlaces);
    capture.lightPlaces.clear();
    capture.lightDistance = distance;
    for (Light& light : capture.lights) { // their own count where nobody says else
        light.distance = distance ? std::numeric_limits<float>::infinity() : light.distance;
    }
    capture.pixelsPerMillimetre =
        options.pixelsPerMillimetre ? options.pixelsPerMillimetre : capture.pixelsPerMillimetre;
    capture.fieldOfView = options.fieldOfView ? options.fieldOfView : capture.fieldOfView;
    if (!distance && !width && !areDirections(vectors)) {
        const char* unused = "their lengths left out: places need --object-width in their unit";
        capture.lightsOrder += (capture.lightsOrder.empty() ? "" : "; ") + std::string(unused);
    }
    if (distance || !width) {
        return;
    }
    if (vectors.empty() || areDirections(vectors)) {
        throw Error(capture.lightsSource.empty() ? capture.folder : fs::path(capture.lightsSource),
                    fmt::format("places no lights, though the object's width is given as {:g}", *width),
                    "the lights' places in the unit of the object's width, or their distance");
    }
    for (const glm::vec3& vector : vectors) {
        capture.lightPlaces.push_back(vector / static_cast<float>(*width));
    }
}

std::string rectangleOf(const SphereInPicture& sphere)
{
    return fmt::format("{},{},{},{}", sphere.x, sphere.y, sphere.width, sphere.height);
}

namespace {

// A sphere's mask beside the photographs is not the object's.
void dropMask(const SphereInPicture& sphere, LayoutContents& contents)
{
    std::error_code ignored;
    std::erase_if(contents.masks, [&](const fs::path& mask) { return fs::equivalent(mask, sphere.mask, ignored); });
}

} // namespace

void addMirrorSphere(const fs::path& specification, LayoutContents& contents)
{
    const std::optional<SphereInPicture> sphere = sphereInPicture("mirror sphere", specification);
    std::optional<SpherePhotographs>& first = contents.capture.mirrorSphere;
    if (!sphere || !first || !first->inPicture) {
        throw Error("",
                    fmt::format("of several mirror spheres, {} is not in the object's own photographs",
                                sphere ? "the first" : specification.string()),
                    "in-picture:X,Y,W,H for each: how they stand to each other places the lights", Error::kUsage);
    }
    dropMask(*sphere, contents);
    first->beside.push_back(*sphere);
    first->source += " and at " + rectangleOf(*sphere);
}

SpherePhotographs namedSphere(const std::string& name, const fs::path& specification, LayoutContents& contents,
                              const std::optional<Circle>& outline)
{
    const std::optional<SphereInPicture> sphere = sphereInPicture(name, specification);
    if (!sphere) {
        return readSphereFolder(specification, outline);
    }
    dropMask(*sphere, contents);
    SpherePhotographs photographs = photographsOfSphere(*sphere, contents.capture);
    photographs.circle = outline;
    return photographs;
}

} // namespace nacre
