#include "engine/lights/environment.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "shared/brdf_coords.h"

namespace nacre {
namespace {

constexpr float kStraightBehind = -0.9998f; // z of a direction within a degree of -v

// A rectangle of pixels: columns [x0, x1), rows [y0, y1).
struct Region {
    int x0, y0, x1, y1;
    double energy;
    bool operator<(const Region& other) const { return energy < other.energy; }
    bool isOnePixel() const { return x1 - x0 == 1 && y1 - y0 == 1; }
};

class EnergySums {
public:
    explicit EnergySums(const Image& radiance) : width_(radiance.width), height_(radiance.height)
    {
        sums_.assign(static_cast<size_t>(width_ + 1) * (height_ + 1), 0.0);
        for (int y = 0; y < height_; ++y) {
            double row = 0;
            for (int x = 0; x < width_; ++x) {
                const glm::vec3 value = radiance.rgb(x, y);
                row += solidAngle(y) * (value.x + value.y + value.z);
                sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + row;
            }
        }
    }
    // Steradians of a pixel.
    double solidAngle(int y) const
    {
        const double top = std::cos(kPi * y / height_), bottom = std::cos(kPi * (y + 1) / height_);
        return 2 * kPi / width_ * (top - bottom);
    }
    double energy(int x0, int y0, int x1, int y1) const
    {
        return sums_[index(x1, y1)] - sums_[index(x0, y1)] - sums_[index(x1, y0)] + sums_[index(x0, y0)];
    }

private:
    size_t index(int x, int y) const { return static_cast<size_t>(y) * (width_ + 1) + x; }
    int width_, height_;
    std::vector<double> sums_;
};

// The longer side on the sphere is cut where half the energy lies on either side.
std::pair<Region, Region> halves(const Region& r, const EnergySums& sums, int height)
{
    const double middle = kPi * (r.y0 + r.y1) / (2.0 * height);
    const bool across = r.y1 - r.y0 == 1 || (r.x1 - r.x0 > 1 && (r.x1 - r.x0) * std::sin(middle) >= r.y1 - r.y0);
    const int first = across ? r.x0 : r.y0, last = across ? r.x1 : r.y1;
    const auto before = [&](int cut) {
        return across ? sums.energy(r.x0, r.y0, cut, r.y1) : sums.energy(r.x0, r.y0, r.x1, cut);
    };
    int cut = first + 1;
    while (cut < last - 1 && before(cut) < r.energy / 2) {
        ++cut;
    }
    const double energy = before(cut);
    Region low = r, high = r;
    (across ? low.x1 : low.y1) = cut;
    (across ? high.x0 : high.y0) = cut;
    low.energy = energy;
    high.energy = std::max(0.0, r.energy - energy);
    return {low, high};
}

Light lightOfRegion(const Image& radiance, const Region& region, const EnergySums& sums)
{
    glm::dvec3 centroid(0), irradiance(0);
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            const glm::dvec3 value = glm::dvec3(radiance.rgb(x, y)) * sums.solidAngle(y);
            irradiance += value;
            centroid += (value.x + value.y + value.z) * environmentDirection(radiance, x, y);
        }
    }
    const double size = glm::length(centroid);
    return {size > 0 ? glm::vec3(centroid / size) : glm::vec3(0, 0, -1), glm::vec3(irradiance)};
}

} // namespace

glm::dvec3 environmentDirection(const Image& radiance, int x, int y)
{
    const double longitude = kPi * (1 - 2 * (x + 0.5) / radiance.width);
    const double latitude = kPi * (0.5 - (y + 0.5) / radiance.height);
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
}

namespace {

std::string clampRadiance(Image& image)
{
    float largest = 0;
    for (const float value : image.values) {
        largest = std::isfinite(value) ? std::max(largest, value) : largest;
    }
    size_t count = 0, first = 0;
    for (size_t i = 0; i < image.values.size(); ++i) {
        float& value = image.values[i];
        if (value >= 0 && std::isfinite(value)) {
            continue;
        }
        value = value > 0 ? largest : 0;
        first = count++ == 0 ? i / image.channels : first;
    }
    return count == 0 ? ""
                      : fmt::format("{} negative or not finite, the first at pixel {}, {}: taken for 0 and {:g}",
                                    count == 1 ? "1 value is" : fmt::format("{} values are", count),
                                    first % image.width, first / image.width, largest);
}

} // namespace

Environment loadEnvironment(const std::filesystem::path& file)
{
    ImageRows rows(file, TransferCurve::linear);
    Image image(rows.header().width, rows.header().height, rows.channels());
    if (image.width != 2 * image.height) {
        throw Error(file, fmt::format("is {} x {} pixels", image.width, image.height),
                    "a latitude-longitude environment, twice as wide as high");
    }
    rows.read(0, image.height, image.values);
    std::string clamped = clampRadiance(image);
    return {std::move(image), std::move(clamped)};
}

std::vector<Light> lightsFromEnvironment(const Environment& environment, int count, float turn)
{
    const Image& radiance = environment.radiance;
    const EnergySums sums(radiance);
    std::priority_queue<Region> regions;
    regions.push({0, 0, radiance.width, radiance.height, sums.energy(0, 0, radiance.width, radiance.height)});
    std::vector<Region> finished;
    while (!regions.empty() && static_cast<int>(regions.size() + finished.size()) < count) {
        const Region region = regions.top();
        regions.pop();
        if (region.isOnePixel() || region.energy <= 0) {
            finished.push_back(region);
            continue;
        }
        const auto [low, high] = halves(region, sums, radiance.height);
        regions.push(low);
        regions.push(high);
    }
    for (; !regions.empty(); regions.pop()) {
        finished.push_back(regions.top());
    }
    std::vector<Light> lights;
    for (const Region& region : finished) {
        Light light = lightOfRegion(radiance, region, sums);
        light.direction = glm::normalize(rotatedAboutY(light.direction, turn));
        const bool isBlack = light.irradiance == glm::vec3(0);
        if (!isBlack && light.direction.z > kStraightBehind) {
            lights.push_back(light);
        }
    }
    return lights;
}

} // namespace nacre
