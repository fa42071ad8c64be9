#include "engine/surface/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/files/error.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// Heights in pixels, kNothing without data.
struct HeightField {
    int width, height;
    std::vector<float> values;
    std::vector<uint8_t> cliffs; // 1 where the surface is torn between the pixel and the one below

    HeightField(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * h, kNothing), cliffs() {}
    float at(int x, int y) const { return values[static_cast<size_t>(y) * width + x]; }
    bool isCliff(int x, int y) const { return y >= 0 && cliffs[static_cast<size_t>(y) * width + x] != 0; }
};

// Where one thing stands before another nothing has a height between theirs. Such a step is higher than its neighbours
// by more than a curved surface's, whose steps grow to at most twice from pixel to pixel even at a sphere's rim.
void findCliffs(HeightField& field)
{
    field.cliffs.assign(field.values.size(), 0);
    const auto step = [&](int x, int y) {
        return y >= 0 && y + 1 < field.height ? std::abs(field.at(x, y + 1) - field.at(x, y)) : kNothing;
    };
    for (int y = 0; y + 1 < field.height; ++y) {
        for (int x = 0; x < field.width; ++x) {
            const float around = std::fmax(0.0f, std::fmax(step(x, y - 1), step(x, y + 1))); // of those with data
            field.cliffs[static_cast<size_t>(y) * field.width + x] = step(x, y) > 1 + 2 * around;
        }
    }
}

HeightField transposed(const HeightField& field)
{
    HeightField turned(field.height, field.width);
    for (int y = 0; y < field.height; ++y) {
        for (int x = 0; x < field.width; ++x) {
            turned.values[static_cast<size_t>(x) * field.height + y] = field.at(x, y);
        }
    }
    return turned;
}

float nearer(float first, float second, float share)
{
    return share < 0.5f ? first : second;
}

// Between two pixels, `share` from the first; of the nearer where the other has no data.
float between(float first, float second, float share)
{
    if (std::isnan(first) || std::isnan(second)) {
        return nearer(first, second, share);
    }
    return first + share * (second - first);
}

// The horizons of one azimuth: parallel lines, one pixel apart, are walked from the light's side away from it, with the
// upper convex hull of what has been passed on a stack: the horizon lies on it (Timonen, Westerholm, Scalable Height
// Field Self-Shadowing, 2010). Lines advance one column and `drift` rows at a time.
class Sweep {
public:
    // The light's azimuth in columns (`forward`: to the right) and rows down per column, |drift| <= 1.
    Sweep(const HeightField& field, bool forward, float drift)
        : field_(field), forward_(forward), stepLength_(std::sqrt(1 + drift * drift)), below_(field.width),
          share_(field.width), before_(field.width), current_(field.width)
    {
        hull_.reserve(field.width);
        for (int step = 0; step < field.width; ++step) {
            const float rows = drift * static_cast<float>(step);
            below_[step] = static_cast<int>(std::floor(rows));
            share_[step] = rows - static_cast<float>(below_[step]);
        }
    }

    // Calls write(x, y, sine) for all pixels.
    template <class Write> void run(Write&& write)
    {
        const int reach = below_.back();
        const int first = std::min(0, -reach) - 1, last = field_.height + std::max(0, -reach);
        sweepLine(first);
        for (int line = first + 1; line <= last; ++line) {
            std::swap(before_, current_);
            sweepLine(line);
            writeBetween(line - 1, write);
        }
    }

private:
    struct Sample {
        float step, height;
    };

    int column(int step) const { return forward_ ? step : field_.width - 1 - step; }
    float heightAt(int x, int y) const { return y >= 0 && y < field_.height ? field_.at(x, y) : kNothing; }
    float lineHeight(int line, int step) const
    {
        const int x = column(step), y = line + below_[step];
        const float above = heightAt(x, y), below = heightAt(x, y + 1);
        return field_.isCliff(x, y) ? nearer(above, below, share_[step]) : between(above, below, share_[step]);
    }

    // Sine of the elevation of the hull's highest sample, seen from this one, which then joins the hull.
    float passed(const Sample& sample)
    {
        while (hull_.size() > 1) {
            const Sample& a = hull_[hull_.size() - 1];
            const Sample& b = hull_[hull_.size() - 2];
            if ((a.height - sample.height) * (b.step - sample.step) >
                (b.height - sample.height) * (a.step - sample.step)) {
                break;
            }
            hull_.pop_back();
        }
        float sine = kLowestHorizon;
        if (!hull_.empty()) {
            const float rise = hull_.back().height - sample.height;
            const float run = (hull_.back().step - sample.step) * stepLength_;
            sine = rise / std::sqrt(rise * rise + run * run);
        }
        hull_.push_back(sample);
        return sine;
    }

    // Steps at which the line touches pixels; below_ falls or grows all along.
    std::pair<int, int> stepsInPicture(int line) const
    {
        const int highest = -1 - line, lowest = field_.height - 1 - line;
        const bool grows = below_.back() >= 0;
        const auto before = [&](int below) { return grows ? below < highest : below > lowest; };
        const auto within = [&](int below) { return grows ? below <= lowest : below >= highest; };
        const auto first = std::partition_point(below_.begin(), below_.end(), before);
        return {first - below_.begin(), std::partition_point(first, below_.end(), within) - below_.begin()};
    }

    // Fills current_, by step.
    void sweepLine(int line)
    {
        hull_.clear();
        std::fill(current_.begin(), current_.end(), kNothing);
        const auto [first, end] = stepsInPicture(line);
        for (int step = end - 1; step >= first; --step) {
            const float height = lineHeight(line, step);
            current_[step] = std::isnan(height) ? kNothing : passed({static_cast<float>(step), height});
        }
    }

    // Of the pixel between two lines; of the one that passes over it where the other may pass over something else.
    float sineBetween(int step, int y) const
    {
        const int x = column(step);
        const bool isTorn = field_.isCliff(x, y - 1) || field_.isCliff(x, y);
        const float share = 1 - share_[step];
        return isTorn ? nearer(before_[step], current_[step], share) : between(before_[step], current_[step], share);
    }

    // The one row of each column that lies between this line and the next.
    template <class Write> void writeBetween(int line, Write&& write)
    {
        const auto [first, end] = stepsInPicture(line);
        for (int step = first; step < end; ++step) {
            const bool isOnLine = share_[step] == 0;
            const int y = line + below_[step] + (isOnLine ? 0 : 1);
            if (y >= 0 && y < field_.height) {
                const float sine = isOnLine ? before_[step] : sineBetween(step, y);
                write(column(step), y, std::isnan(sine) ? kLowestHorizon : sine);
            }
        }
    }

    const HeightField& field_;
    bool forward_;
    float stepLength_;
    // By step: rows down from the line's first to the pixel above the sample, and the sample's way to the one below.
    std::vector<int> below_;
    std::vector<float> share_;
    std::vector<Sample> hull_;
    std::vector<float> before_, current_; // sines of neighbouring lines, kNothing without data
};

// `turned` is `field` transposed, for azimuths nearer to the vertical: lines are walked along memory's rows.
void bakeAzimuth(HorizonMap& map, int azimuth, const HeightField& field, const HeightField& turned)
{
    const double angle = 2.0 * kPi * azimuth / map.azimuths;
    const double right = std::cos(angle), down = -std::sin(angle);
    const bool flat = std::abs(right) >= std::abs(down);
    const double along = flat ? right : down, across = flat ? down : right;
    uint8_t* codes = &map.at(azimuth, 0);
    Sweep sweep(flat ? field : turned, along > 0, static_cast<float>(across / std::abs(along)));
    sweep.run([&](int x, int y, float sine) {
        const size_t pixel = flat ? static_cast<size_t>(y) * map.width + x : static_cast<size_t>(x) * map.width + y;
        codes[pixel] = static_cast<uint8_t>(codeFromHorizon(sine) + 0.5f);
    });
}

} // namespace

HorizonMap horizonMap(const NormalMap& normals, const Image& height, int azimuths, int threads)
{
    if (height.width != normals.width || height.height != normals.height || height.channels != 1) {
        throw Error({}, "the height has another shape than the normals", "one channel of their size");
    }
    HeightField field(height.width, height.height);
    for (size_t i = 0; i < field.values.size(); ++i) {
        field.values[i] = normals.confidence[i] > 0 ? height.values[i] : kNothing;
    }
    HeightField turned = transposed(field);
    findCliffs(field);
    findCliffs(turned);
    HorizonMap map(height.width, height.height, azimuths);
    parallelFor(static_cast<size_t>(azimuths), 1, threads, [&](size_t first, size_t last) {
        for (size_t azimuth = first; azimuth < last; ++azimuth) {
            bakeAzimuth(map, static_cast<int>(azimuth), field, turned);
        }
    });
    return map;
}

float visibilityOf(const HorizonMap& map, const glm::vec4& lookup, size_t pixel)
{
    if (map.empty()) {
        return 1;
    }
    return visibility(lookup, map.at(static_cast<int>(lookup.x), pixel), map.at(static_cast<int>(lookup.y), pixel));
}

HorizonMap pickedHorizon(const HorizonMap& map, const std::vector<int64_t>& from, int width, int height)
{
    if (map.empty()) {
        return {};
    }
    HorizonMap picked(width, height, map.azimuths);
    for (int azimuth = 0; azimuth < map.azimuths; ++azimuth) {
        for (size_t i = 0; i < from.size(); ++i) {
            if (from[i] >= 0) {
                picked.at(azimuth, i) = map.at(azimuth, static_cast<size_t>(from[i]));
            }
        }
    }
    return picked;
}

} // namespace nacre
