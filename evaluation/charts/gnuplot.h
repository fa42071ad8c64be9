#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nacre {

// A picture that gnuplot draws from a table in the same folder.
struct Plot {
    std::string name;   // of the script NAME.gp, and of the picture NAME.svg that it writes
    std::string script; // begins with plotHead
};

// What all scripts begin with: the picture's file, size in pixels and title, how tables are read, colours and marks.
std::string plotHead(const std::string& name, const std::string& title, int width, int height);

// As gnuplot reads it between single quotes, where it substitutes nothing.
std::string quoted(const std::string& text);

// Writes every script into the folder and has gnuplot draw there. Answers what to tell the user: nothing where all
// pictures were drawn.
std::string drawPlots(const std::filesystem::path& folder, const std::vector<Plot>& plots);

// The picture within a page, or nothing where it was not drawn.
std::string plotFigure(const std::filesystem::path& folder, const Plot& plot);

} // namespace nacre
