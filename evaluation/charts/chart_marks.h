#pragma once
#include <cstddef>
#include <string>

namespace nacre {

// Told apart by people who do not see red and green as two: Okabe, Ito, Color Universal Design, 2008.
inline constexpr const char* kFrontColour = "#0072b2";
inline constexpr const char* kDominatedColour = "#b4b4b4";
inline constexpr const char* kDefaultColour = "#d55e00";

// Pieces of an SVG picture, coordinates in pixels.

// One shape a series; they repeat after the seventh.
std::string seriesMark(double x, double y, size_t series, const std::string& fill);
// About the mark of the default.
std::string ringMark(double x, double y);
// `anchor`: start, middle or end; `more`: further attributes, each with a space before it.
std::string textMark(double x, double y, const char* anchor, const std::string& content, const std::string& more = "");
std::string lineMark(double x0, double y0, double x1, double y1, const char* colour);

// For XML and HTML, in text and in attributes.
std::string escaped(const std::string& text);

} // namespace nacre
