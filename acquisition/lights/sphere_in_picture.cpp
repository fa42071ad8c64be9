#include "acquisition/lights/sphere_in_picture.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/lights/sphere_outline.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// Where a picture changes most across a line.
struct EdgePoint {
    glm::vec2 at;        // image coordinates, see Circle
    glm::vec2 direction; // unit, towards the brighter side
    float strength;
};

// Sobel's, per pixel.
glm::vec2 gradientAt(const Image& picture, int x, int y)
{
    const auto value = [&](int dx, int dy) { return picture.at(x + dx, y + dy); };
    return glm::vec2(value(1, -1) + 2 * value(1, 0) + value(1, 1) - value(-1, -1) - 2 * value(-1, 0) - value(-1, 1),
                     value(-1, 1) + 2 * value(0, 1) + value(1, 1) - value(-1, -1) - 2 * value(0, -1) - value(1, -1)) /
           8.0f;
}

Image gradientsOf(const Image& picture)
{
    Image gradients(picture.width, picture.height, 2);
    for (int y = 1; y + 1 < picture.height; ++y) {
        for (int x = 1; x + 1 < picture.width; ++x) {
            const glm::vec2 gradient = gradientAt(picture, x, y);
            gradients.at(x, y, 0) = gradient.x;
            gradients.at(x, y, 1) = gradient.y;
        }
    }
    return gradients;
}

// The picture with boxes of `box` x `box` pixels averaged to one; what is left over at the right and below is dropped.
Image boxAveraged(const Image& picture, int box)
{
    Image averaged(picture.width / box, picture.height / box, 1);
    for (int y = 0; y < averaged.height; ++y) {
        for (int x = 0; x < averaged.width; ++x) {
            float sum = 0;
            for (int step = 0; step < box * box; ++step) {
                sum += picture.at(x * box + step % box, y * box + step / box);
            }
            averaged.at(x, y) = sum / static_cast<float>(box * box);
        }
    }
    return averaged;
}

// The `most` strongest of the points whose gradient is largest along its own direction (Canny, A computational approach
// to edge detection, 1986). `picture` has one channel.
std::vector<EdgePoint> strongestEdges(const Image& picture, size_t most)
{
    const Image gradients = gradientsOf(picture);
    const auto lengthAt = [&](int x, int y) { return std::hypot(gradients.at(x, y, 0), gradients.at(x, y, 1)); };
    std::vector<EdgePoint> points;
    for (int y = 2; y + 2 < picture.height; ++y) {
        for (int x = 2; x + 2 < picture.width; ++x) {
            const float strength = lengthAt(x, y);
            if (!(strength > 0)) {
                continue;
            }
            const glm::vec2 direction = glm::vec2(gradients.at(x, y, 0), gradients.at(x, y, 1)) / strength;
            const int dx = static_cast<int>(std::lround(direction.x)), dy = static_cast<int>(std::lround(direction.y));
            if (strength > lengthAt(x - dx, y - dy) && strength >= lengthAt(x + dx, y + dy)) {
                points.push_back({{x + 0.5f, y + 0.5f}, direction, strength});
            }
        }
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const EdgePoint& a, const EdgePoint& b) { return a.strength > b.strength; });
    points.resize(std::min(points.size(), most));
    return points;
}

// Bilinear, at image coordinates; the border's value beyond it.
float sampleAt(const Image& picture, const glm::dvec2& at)
{
    const double x = std::clamp(at.x - 0.5, 0.0, picture.width - 1.0);
    const double y = std::clamp(at.y - 0.5, 0.0, picture.height - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
    const float fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
    return (1 - fy) * ((1 - fx) * picture.at(x0, y0) + fx * picture.at(x1, y0)) +
           fy * ((1 - fx) * picture.at(x0, y1) + fx * picture.at(x1, y1));
}

constexpr int kSearchSide = 300; // pixels, of the longer side, that the search works on
constexpr size_t kMostEdges = 3000;
// A circle that is a tenth of the edges is drawn once in a thousand.
constexpr int kCircleTriples = 20000;
constexpr float kRadial = 0.92f;     // cosine between an edge's direction and the circle's radius: 23 degrees
constexpr float kNear = 1.5f;        // pixels from the circle, in the search
constexpr double kLeastSeen = 0.6;   // of the circle; a stand or a dull ground may take the rest
constexpr double kLeastRadius = 0.2; // of the shorter side
constexpr double kOutside = 0.03;    // of the radius that may lie beyond the picture
constexpr size_t kSectors = 180;
constexpr int kRays = 360;
constexpr uint64_t kSeed = 1; // of the triples

bool isPlausible(const Circle& c, int width, int height)
{
    const double margin = c.radius * (1 - kOutside);
    return c.radius >= kLeastRadius * std::min(width, height) && c.x >= margin && c.y >= margin &&
           c.x + margin <= width && c.y + margin <= height;
}

// Through three points; the radius is not finite where they lie on a line.
Circle circleThrough(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    const glm::dvec2 u = b - a, v = c - a;
    const double cross = 2 * (u.x * v.y - u.y * v.x);
    const glm::dvec2 centre =
        glm::dvec2(v.y * glm::dot(u, u) - u.y * glm::dot(v, v), u.x * glm::dot(v, v) - v.x * glm::dot(u, u)) / cross;
    return {a.x + centre.x, a.y + centre.y, glm::length(centre)};
}

bool liesOn(const EdgePoint& point, const Circle& circle)
{
    const glm::vec2 radius = point.at - glm::vec2(circle.x, circle.y);
    const float distance = glm::length(radius);
    return std::abs(distance - static_cast<float>(circle.radius)) < kNear &&
           std::abs(glm::dot(radius, point.direction)) > kRadial * distance;
}

size_t seenSectors(const std::vector<EdgePoint>& edges, const Circle& circle)
{
    std::bitset<kSectors> seen;
    for (const EdgePoint& point : edges) {
        if (liesOn(point, circle)) {
            const double turns = std::atan2(point.at.y - circle.y, point.at.x - circle.x) / (2 * M_PI) + 0.5;
            seen.set(std::min(static_cast<size_t>(turns * kSectors), kSectors - 1));
        }
    }
    return seen.count();
}

std::optional<Circle> bestThroughTriples(const std::vector<EdgePoint>& edges, int width, int height)
{
    std::mt19937_64 random(kSeed); // its numbers are the standard's, alike everywhere
    std::optional<Circle> best;
    size_t mostSeen = 0;
    for (int i = 0; i < kCircleTriples && edges.size() >= 3; ++i) {
        std::array<const EdgePoint*, 3> points;
        std::generate(points.begin(), points.end(), [&] { return &edges[random() % edges.size()]; });
        const Circle circle = circleThrough(points[0]->at, points[1]->at, points[2]->at);
        if (!std::isfinite(circle.radius) || !isPlausible(circle, width, height) ||
            !std::all_of(points.begin(), points.end(), [&](const auto* p) { return liesOn(*p, circle); })) {
            continue;
        }
        const size_t seen = seenSectors(edges, circle);
        if (seen > mostSeen) {
            mostSeen = seen;
            best = circle;
        }
    }
    return best;
}

// Where the picture changes most along a ray from the circle's centre, within `reach` pixels of the circle.
glm::dvec2 steepestOnRay(const Image& picture, const Circle& circle, double azimuth, double reach)
{
    constexpr double kStep = 0.25;
    const glm::dvec2 centre(circle.x, circle.y), ray(std::cos(azimuth), std::sin(azimuth));
    const auto change = [&](double r) {
        return std::abs(sampleAt(picture, centre + (r + 0.5) * ray) - sampleAt(picture, centre + (r - 0.5) * ray));
    };
    double steepest = 0, radius = circle.radius;
    for (double r = circle.radius - reach; r <= circle.radius + reach; r += kStep) {
        if (change(r) > steepest) {
            steepest = change(r);
            radius = r;
        }
    }
    double sum = 0, moment = 0; // the middle of the change: an edge is as wide as its blur
    for (double r = radius - 1.5; r <= radius + 1.5; r += kStep) {
        sum += change(r);
        moment += r * change(r);
    }
    return centre + (sum > 0 ? moment / sum : radius) * ray;
}

// Fits the circle to the edges on its rays; empty where too few of them are on one.
std::optional<Circle> fittedToRays(const Image& picture, Circle circle, double reach)
{
    std::vector<glm::dvec2> points;
    for (int pass = 0; pass < 2; ++pass) {
        points.clear();
        for (int i = 0; i < kRays; ++i) {
            points.push_back(steepestOnRay(picture, circle, 2 * M_PI * i / kRays, reach));
        }
        circle = refinedCircle(circle, points);
        reach = std::max(reach / 2, 2.0);
    }
    const double near = std::max(1.0, 0.01 * circle.radius);
    const auto on = std::count_if(points.begin(), points.end(), [&](const glm::dvec2& point) {
        return std::abs(std::hypot(point.x - circle.x, point.y - circle.y) - circle.radius) < near;
    });
    return static_cast<double>(on) >= kLeastSeen * kRays ? std::optional(circle) : std::nullopt;
}

} // namespace

std::optional<Circle> findCircle(const Image& picture)
{
    Image eye = picture; // square roots, so that a dark outline on darker ground counts as it does to the eye
    std::transform(eye.values.begin(), eye.values.end(), eye.values.begin(),
                   [](float value) { return std::sqrt(std::max(value, 0.0f)); });
    const int box = (std::max(eye.width, eye.height) + kSearchSide - 1) / kSearchSide;
    const Image small = boxAveraged(eye, box);
    const std::vector<EdgePoint> edges = strongestEdges(small, kMostEdges);
    std::optional<Circle> circle = bestThroughTriples(edges, small.width, small.height);
    if (!circle || static_cast<double>(seenSectors(edges, *circle)) < kLeastSeen * kSectors) {
        return std::nullopt;
    }
    circle = fittedToRays(eye, {circle->x * box, circle->y * box, circle->radius * box}, (kNear + 1) * box);
    return circle && isPlausible(*circle, eye.width, eye.height) ? circle : std::nullopt;
}

namespace {

constexpr size_t kMostPhotographs = 15; // little to read
// Of a pixel's values: a highlight is brighter in one or two of the photographs, and the sphere's own shadow on what it
// stands on is there, beside the outline, in up to half of them.
constexpr double kUsualQuantile = 0.75;

void requireInside(const SphereInPicture& sphere, const Capture& capture)
{
    const FileWindow& files = capture.window;
    const bool inside = sphere.width <= files.fileWidth && sphere.height <= files.fileHeight &&
                        sphere.x <= files.fileWidth - sphere.width && sphere.y <= files.fileHeight - sphere.height;
    if (!inside) {
        throw Error(capture.photographs[0].exposures[0].file,
                    fmt::format("is {} x {}, the sphere's crop {} is not inside", files.fileWidth, files.fileHeight,
                                rectangleOf(sphere)),
                    "X,Y,W,H in pixels, the top left pixel being 0,0");
    }
}

// Grey values of the crop.
std::vector<float> cropOf(const SphereInPicture& sphere, const fs::path& file, const TransferCurve& curve)
{
    ImageRows rows(file, curve);
    const int channels = rows.channels();
    const size_t width = rows.header().width;
    std::vector<float> values(width * sphere.height * channels);
    rows.read(sphere.y, sphere.y + sphere.height, values);
    std::vector<float> crop;
    crop.reserve(static_cast<size_t>(sphere.width) * sphere.height);
    for (int y = 0; y < sphere.height; ++y) {
        for (int x = 0; x < sphere.width; ++x) {
            const float* p = &values[(y * width + sphere.x + x) * channels];
            crop.push_back(channels == 3 ? channelMean({p[0], p[1], p[2]}) : p[0]);
        }
    }
    return crop;
}

Image usualCrop(const SphereInPicture& sphere, const Capture& capture)
{
    const size_t all = capture.photographs.size(), count = std::min(all, kMostPhotographs);
    std::vector<std::vector<float>> crops;
    for (size_t i = 0; i < count; ++i) {
        crops.push_back(cropOf(sphere, capture.photographs[i * all / count].exposures[0].file, capture.curve));
    }
    Image usual(sphere.width, sphere.height, 1);
    std::vector<float> values(count);
    for (size_t pixel = 0; pixel < usual.values.size(); ++pixel) {
        std::transform(crops.begin(), crops.end(), values.begin(), [pixel](const auto& crop) { return crop[pixel]; });
        usual.values[pixel] = quantile(values, kUsualQuantile);
    }
    return usual;
}

// Of the crop's size.
std::vector<uint8_t> loadSphereMask(const SphereInPicture& sphere, const FileWindow& files)
{
    const ImageHeader header = readImageHeader(sphere.mask);
    if (header.width == sphere.width && header.height == sphere.height) {
        return loadMask(sphere.mask, sphere.width, sphere.height).inside;
    }
    if (header.width != files.fileWidth || header.height != files.fileHeight) {
        throw Error(sphere.mask, fmt::format("is {} x {}", header.width, header.height),
                    fmt::format("{} x {} as the photographs, or {} x {} as the sphere's crop", files.fileWidth,
                                files.fileHeight, sphere.width, sphere.height));
    }
    const std::vector<uint8_t> whole = loadMask(sphere.mask, header.width, header.height).inside;
    std::vector<uint8_t> crop;
    for (int y = 0; y < sphere.height; ++y) {
        const auto row = whole.begin() + static_cast<std::ptrdiff_t>(sphere.y + y) * header.width + sphere.x;
        crop.insert(crop.end(), row, row + sphere.width);
    }
    return crop;
}

} // namespace

Circle circleInPicture(const SphereInPicture& sphere, const Capture& capture)
{
    requireInside(sphere, capture);
    std::optional<Circle> circle;
    if (!sphere.mask.empty()) {
        circle = fitCircle(loadSphereMask(sphere, capture.window), sphere.width, sphere.height, sphere.mask);
    } else {
        circle = findCircle(usualCrop(sphere, capture));
    }
    if (!circle) {
        throw Error(capture.photographs[0].exposures[0].file,
                    fmt::format("shows no outline of a sphere at {}", rectangleOf(sphere)),
                    "X,Y,W,H around one sphere and little else, its mask after the numbers, or --circle");
    }
    return {circle->x + sphere.x, circle->y + sphere.y, circle->radius};
}

} // namespace nacre
