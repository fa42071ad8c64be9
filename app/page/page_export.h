#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/arguments/model_arguments.h"
#include "engine/page/page.h"

namespace nacre {

// What nacre export --page takes beside the surface.
struct PageArguments {
    std::filesystem::path file;
    std::vector<std::string> onto, materials; // as nacre transfer takes them
    std::filesystem::path capture;            // of the photographs
    int photographs = 0;
    LadderArguments size{.tolerance = "50dB", .budget = ""};
    std::filesystem::path fits;
    bool shadows = false; // of the shapes, from their heights
    int threads = 0;

    void addTo(CLI::App& command);
    // Throws usage Errors.
    void check() const;
};

struct SurfacePage {
    PageText text;
    std::vector<std::string> lines;    // what was taken, and what it costs
    std::vector<std::string> warnings; // for stderr
};

// The page of a surface that was read from `folder`, its horizon baked where it is to cast shadows. `shapes`: before
// those of --onto, without materials. Throws Error.
SurfacePage pageOfSurface(const PageArguments& arguments, const std::filesystem::path& folder, Surface surface,
                          std::vector<PageShape> shapes = {});

} // namespace nacre
