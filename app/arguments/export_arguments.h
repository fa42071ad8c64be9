#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace nacre {

struct ExportArguments {
    std::filesystem::path surface;
    std::filesystem::path ptm;
    std::filesystem::path web;
    std::filesystem::path normals;
    std::filesystem::path albedo;
    std::string ptmFormat = "lrgb";
    std::string basis = "hsh";
    std::string size;
    std::optional<float> exposure;
    int lights = 64;
    int threads = 0;
    bool shadows = false;
    bool quiet = false;
    bool force = false;

    void addTo(CLI::App& command);
    // Throws usage Errors, and data Errors for outputs that cannot be written.
    void check() const;
};

} // namespace nacre
