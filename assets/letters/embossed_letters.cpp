#include "assets/letters/embossed_letters.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "assets/letters/stroke_letters.h"
#include "assets/synth/relief.h"
#include "assets/synth/smooth_noise.h"
#include "engine/files/error.h"

namespace nacre {
namespace {

using glm::dvec2;

// In heights of a capital.
constexpr double kLetterSpace = 0.16; // between strokes' edges, so that they stay apart
constexpr double kLineSpace = 0.55;
// In the plane's unit.
constexpr double kRimInset = 0.055; // of the rim's middle line from the picture's border
constexpr double kRimBreadth = 0.05;
constexpr double kTextMargin = 0.17; // from the picture's border
constexpr double kDome = 0.05;       // the plate's middle rises so far, so that no light finds it all alike

struct PlacedStroke {
    Stroke points;
    dvec2 least, most; // with the stroke's reach
};

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line, '/');) {
        for (char letter : line) {
            if (!hasGlyph(letter)) {
                throw Error({}, fmt::format("target \"letters:{}\": there is no drawing of \"{}\"", text, letter),
                            fmt::format("letters among \"{}\", and / between lines", glyphLetters()), Error::kUsage);
            }
        }
        lines.push_back(line);
    }
    if (std::all_of(text.begin(), text.end(), [](char c) { return c == ' ' || c == '/'; })) {
        throw Error({}, "target \"letters\": there is no letter in its text", "letters:TEXT", Error::kUsage);
    }
    return lines;
}

double widthOf(const std::string& line, double gap)
{
    double width = -gap;
    for (char letter : line) {
        width += glyphOf(letter).width + gap;
    }
    return std::max(0.0, width);
}

class Plate {
public:
    Plate(const EmbossedLettersOptions& options, const dvec2& halfSize) : options_(options), halfSize_(halfSize)
    {
        const std::vector<std::string> lines = linesOf(options.text);
        const double gap = options.stroke + kLetterSpace;
        double widest = 0;
        for (const std::string& line : lines) {
            widest = std::max(widest, widthOf(line, gap));
        }
        const double tall = static_cast<double>(lines.size()) * (1 + kLineSpace) - kLineSpace;
        const dvec2 room = 2.0 * (halfSize - kTextMargin);
        scale_ = std::min(room.x / (widest + options.stroke), room.y / (tall + options.stroke));
        for (size_t i = 0; i < lines.size(); ++i) {
            const double baseline = 0.5 * tall - 1 - static_cast<double>(i) * (1 + kLineSpace);
            placeLine(lines[i], dvec2(-0.5 * widthOf(lines[i], gap), baseline), gap);
        }
    }

    ReliefPoint at(const dvec2& p) const
    {
        const dvec2 share = p / halfSize_;
        const double dome = kDome * (1 - 0.5 * glm::dot(share, share));
        const double letter = letterHeight(p / scale_) * scale_;
        const double rim = rimHeight(p);
        const bool onLetter = letter > 0.25 * options_.relief * scale_;
        return {dome + std::max(letter, rim) + unevenness(p), static_cast<uint8_t>(onLetter)};
    }

private:
    void placeLine(const std::string& line, dvec2 pen, double gap)
    {
        const dvec2 reach(0.5 * options_.stroke);
        for (char letter : line) {
            const Glyph glyph = glyphOf(letter);
            for (Stroke points : glyph.strokes) {
                dvec2 least(1e9), most(-1e9);
                for (dvec2& point : points) {
                    point += pen;
                    least = glm::min(least, point), most = glm::max(most, point);
                }
                strokes_.push_back({std::move(points), least - reach, most + reach});
            }
            pen.x += glyph.width + gap;
        }
    }

    // A rise over the bevel with rounded feet and edges; `inside` from the border, over the bevel's breadth.
    static double bevelled(double inside) { return smoothStep(std::clamp(inside, 0.0, 1.0)); }

    // In heights of a capital, as p.
    double letterHeight(const dvec2& p) const
    {
        double distance = options_.stroke;
        for (const PlacedStroke& stroke : strokes_) {
            if (glm::all(glm::lessThan(stroke.least, p)) && glm::all(glm::lessThan(p, stroke.most))) {
                distance = std::min(distance, distanceToStroke(p, stroke.points));
            }
        }
        const double half = 0.5 * options_.stroke;
        return options_.relief * bevelled((half - distance) / (half * options_.bevel));
    }

    // A rounded bar along the border, with round corners.
    double rimHeight(const dvec2& p) const
    {
        constexpr double kCorner = 0.12;
        const dvec2 beyond = glm::abs(p) - (halfSize_ - kRimInset - kCorner);
        const double outside = glm::length(glm::max(beyond, 0.0)) + std::min(std::max(beyond.x, beyond.y), 0.0);
        const double half = 0.5 * kRimBreadth;
        return 0.5 * kRimBreadth * bevelled((half - std::abs(outside - kCorner)) / (half * 0.8));
    }

    // Octaves are turned against each other, or the noise's lattice would show under raking light.
    double unevenness(const dvec2& p) const
    {
        struct Octave {
            double frequency, height, turn;
        };
        constexpr Octave kOctaves[] = {{3.1, 0.008, 0.5}, {6.7, 0.0026, 1.3}, {14.9, 0.0009, 2.2}, {33.0, 0.0003, 2.9}};
        double sum = 0;
        uint64_t seed = hashOf(options_.seed);
        for (const Octave& octave : kOctaves) {
            const dvec2 axis(std::cos(octave.turn), std::sin(octave.turn));
            const dvec2 turned(glm::dot(axis, p), axis.x * p.y - axis.y * p.x);
            sum += octave.height * smoothNoise(octave.frequency * turned, ++seed);
        }
        return options_.roughness * sum;
    }

    EmbossedLettersOptions options_;
    dvec2 halfSize_;
    double scale_ = 1; // a capital's height, in the plane's unit
    std::vector<PlacedStroke> strokes_;
};

} // namespace

Target embossedLetters(int width, int height, const EmbossedLettersOptions& options, int threads)
{
    const Plate plate(options, dvec2(width, height) / static_cast<double>(std::min(width, height)));
    return targetFromRelief(
        width, height, {"plate", "letters"}, [&](const dvec2& p) { return plate.at(p); }, threads);
}

} // namespace nacre
