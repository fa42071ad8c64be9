#include "assets/letters/embossed_letters.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "assets/synth/smooth_noise.h"
#include "engine/files/error.h"

namespace nacre {

namespace {

using glm::dvec2;

// Capitals are 12 units high. M x y starts a stroke, L x y goes on straight, A x y rx ry from to goes on along an
// ellipse about x, y between two angles in degrees (0 = right, 90 = up).
struct Drawing {
    char letter;
    double width;
    std::string_view path;
};

constexpr Drawing kDrawings[] = {
    {' ', 4, ""},
    {'A', 9, "M 0 0 L 4.5 12 L 9 0 M 1.6 4.2 L 7.4 4.2"},
    {'B', 7.5,
     "M 0 0 L 0 12 L 3.6 12 A 3.6 9.1 3 2.9 90 -90 L 0 6.2 M 3.6 6.2 L 4.2 6.2 A 4.2 3.1 3.3 3.1 90 -90 L 0 0"},
    {'C', 9, "M 8.9 9.4 A 5 6 5 6 35 325"},
    {'D', 8.5, "M 0 0 L 0 12 L 3 12 A 3 6 5.5 6 90 -90 L 0 0"},
    {'E', 6.5, "M 6.5 12 L 0 12 L 0 0 L 6.5 0 M 0 6.2 L 5.4 6.2"},
    {'F', 6.5, "M 6.5 12 L 0 12 L 0 0 M 0 6.2 L 5.4 6.2"},
    {'G', 9.5, "M 8.9 9.6 A 5 6 5 6 37 360 L 10 5.6 L 5.6 5.6"},
    {'H', 8, "M 0 0 L 0 12 M 8 0 L 8 12 M 0 6.2 L 8 6.2"},
    {'I', 0, "M 0 0 L 0 12"},
    {'J', 5, "M 5 12 L 5 3 A 2.5 3 2.5 3 0 -165"},
    {'K', 7.5, "M 0 0 L 0 12 M 7.2 12 L 0 4.8 M 2.6 7.4 L 7.6 0"},
    {'L', 6, "M 0 12 L 0 0 L 6 0"},
    {'M', 10, "M 0 0 L 0.8 12 L 5 2.5 L 9.2 12 L 10 0"},
    {'N', 8.5, "M 0 0 L 0 12 L 8.5 0 L 8.5 12"},
    {'O', 10, "M 10 6 A 5 6 5 6 0 360"},
    {'P', 7, "M 0 0 L 0 12 L 3.6 12 A 3.6 8.8 3.4 3.2 90 -90 L 0 5.6"},
    {'Q', 10, "M 10 6 A 5 6 5 6 0 360 M 6 3 L 9.6 -0.8"},
    {'R', 7.5, "M 0 0 L 0 12 L 3.6 12 A 3.6 8.9 3.3 3.1 90 -90 L 0 5.8 M 3.6 5.8 L 7.6 0"},
    {'S', 7, "M 6.6 9.9 A 3.6 9 3.2 3 25 270 A 3.5 3 3.5 3 90 -155"},
    {'T', 8.5, "M 0 12 L 8.5 12 M 4.25 12 L 4.25 0"},
    {'U', 8, "M 0 12 L 0 4 A 4 4 4 4 180 360 L 8 12"},
    {'V', 9, "M 0 12 L 4.5 0 L 9 12"},
    {'W', 12.5, "M 0 12 L 3.2 0 L 6.25 10 L 9.3 0 L 12.5 12"},
    {'X', 8, "M 0 0 L 8 12 M 0 12 L 8 0"},
    {'Y', 8.5, "M 0 12 L 4.25 6 L 8.5 12 M 4.25 6 L 4.25 0"},
    {'Z', 8, "M 0 12 L 8 12 L 0 0 L 8 0"},
    {'0', 8, "M 8 6 A 4 6 4 6 0 360"},
    {'1', 3, "M 0 9.6 L 3 12 L 3 0"},
    {'2', 7, "M 0 9 A 3.4 8.6 3.4 3.4 170 -38 L 0 0 L 7 0"},
    {'3', 7, "M 0.6 10.6 A 3.4 9.1 3 2.9 150 -90 A 3.4 3.1 3.5 3.1 90 -150"},
    {'4', 8, "M 6 0 L 6 12 L 0 3.4 L 8 3.4"},
    {'5', 7, "M 6.4 12 L 1.2 12 L 0.6 6.4 A 3.2 3.8 3.8 3.8 132 -145"},
    {'6', 7.5, "M 6 12 A 7 4 7 8.2 98 180 A 3.75 3.7 3.75 3.7 180 540"},
    {'7', 7, "M 0 12 L 7 12 L 2.2 0"},
    {'8', 7.4, "M 3.7 6.4 A 3.7 9.2 2.9 2.8 -90 270 A 3.7 3.2 3.7 3.2 90 450"},
    {'9', 7.5, "M 1.5 0 A 0.5 8 7 8.2 -82 0 A 3.75 8.3 3.75 3.7 0 360"},
    {'.', 0, "M 0 0 L 0 0.1"},
    {'-', 4, "M 0 5.6 L 4 5.6"},
    {'+', 7, "M 0 5.6 L 7 5.6 M 3.5 2.1 L 3.5 9.1"},
    {'!', 0, "M 0 12 L 0 3.6 M 0 0 L 0 0.1"},
    {'\'', 0, "M 0 12 L 0 9.4"},
};
constexpr double kUnits = 12;

const Drawing* drawingOf(char letter)
{
    const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    const auto* found = std::find_if(std::begin(kDrawings), std::end(kDrawings),
                                     [&](const Drawing& drawing) { return drawing.letter == capital; });
    return found == std::end(kDrawings) ? nullptr : found;
}

void appendArc(Stroke& stroke, const dvec2& middle, const dvec2& radii, double from, double to)
{
    constexpr double kDegreesAPiece = 5;
    const int pieces = static_cast<int>(std::ceil(std::abs(to - from) / kDegreesAPiece));
    for (int i = 0; i <= pieces; ++i) {
        const double angle = (from + (to - from) * i / pieces) * std::numbers::pi / 180.0;
        stroke.push_back((middle + radii * dvec2(std::cos(angle), std::sin(angle))) / kUnits);
    }
}

} // namespace

bool hasGlyph(char letter)
{
    return drawingOf(letter) != nullptr;
}

Glyph glyphOf(char letter)
{
    const Drawing* drawing = drawingOf(letter);
    assert(drawing);
    Glyph glyph{{}, drawing->width / kUnits};
    std::istringstream path{std::string(drawing->path)};
    char command = 0;
    for (dvec2 p; path >> command >> p.x >> p.y;) {
        if (command == 'M') {
            glyph.strokes.push_back({p / kUnits});
        } else if (command == 'L') {
            glyph.strokes.back().push_back(p / kUnits);
        } else {
            dvec2 radii;
            double from = 0, to = 0;
            path >> radii.x >> radii.y >> from >> to;
            appendArc(glyph.strokes.back(), p, radii, from, to);
        }
    }
    return glyph;
}

std::string glyphLetters()
{
    std::string letters;
    for (const Drawing& drawing : kDrawings) {
        letters += drawing.letter;
    }
    return letters;
}

double distanceToStroke(const dvec2& p, const Stroke& stroke)
{
    double nearest = std::numeric_limits<double>::max(); // squared
    for (size_t i = 1; i < stroke.size(); ++i) {
        const dvec2 step = stroke[i] - stroke[i - 1], away = p - stroke[i - 1];
        const double squared = glm::dot(step, step);
        const double share = squared > 0 ? std::clamp(glm::dot(away, step) / squared, 0.0, 1.0) : 0.0;
        const dvec2 left = away - share * step;
        nearest = std::min(nearest, glm::dot(left, left));
    }
    return std::sqrt(nearest);
}

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
