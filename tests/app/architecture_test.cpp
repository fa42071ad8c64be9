// The arrows of docs/architecture.md, by grep: what a part may not know, its files may not include.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;

struct Rule {
    const char* folder;
    std::vector<const char*> forbidden;
};

const Rule kRules[] = {
    {"shaders/shared", {"engine/", "acquisition/", "OpenImageIO", "vulkan", "Eigen", "nanoflann"}},
    {"engine/scene",
     {"vulkan", "GLFW", "imgui", "Eigen", "nanoflann", "engine/gpu", "engine/target", "assimp", "acquisition/",
      "assets/", "app/"}},
    {"engine/gpu",
     {"engine/target", "assimp", "GLFW", "imgui", "OpenImageIO", "acquisition/", "assets/", "app/", "Eigen",
      "nanoflann"}},
    {"engine/target", {"GLFW", "imgui", "OpenImageIO", "acquisition/", "assets/", "app/", "Eigen", "nanoflann"}},
    {"engine/viewer", {"OpenImageIO", "acquisition/", "assets/", "evaluation/", "app/", "Eigen", "nanoflann"}},
    {"acquisition",
     {"assimp", "engine/target", "vulkan", "GLFW", "imgui", "OpenImageIO", "engine/gpu", "assets/", "app/"}},
    {"evaluation", {"GLFW", "imgui", "OpenImageIO", "app/"}},
    {"assets",
     {"assimp", "engine/target", "vulkan", "GLFW", "imgui", "OpenImageIO", "engine/gpu", "acquisition/", "app/"}},
};

bool isSource(const fs::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".h" || extension == ".cpp";
}

std::vector<std::string> includesOf(const fs::path& file)
{
    std::vector<std::string> includes;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("#include", 0) == 0) {
            includes.push_back(line);
        }
    }
    return includes;
}

TEST(Architecture, NoPartIncludesWhatItMayNotKnow)
{
    size_t seen = 0;
    for (const Rule& rule : kRules) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(NACRE_SOURCE_DIR) / rule.folder)) {
            if (!isSource(entry.path())) {
                continue;
            }
            for (const std::string& include : includesOf(entry.path())) {
                ++seen;
                for (const char* word : rule.forbidden) {
                    EXPECT_EQ(include.find(word), std::string::npos) << entry.path() << " has " << include;
                }
            }
        }
    }
    EXPECT_GT(seen, 100u) << "the sources were not found";
}

TEST(Architecture, OneFileKnowsOpenImageIO)
{
    std::vector<fs::path> knowing;
    for (const char* folder : {"engine", "acquisition", "assets", "evaluation", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(NACRE_SOURCE_DIR) / folder)) {
            if (!isSource(entry.path())) {
                continue;
            }
            for (const std::string& include : includesOf(entry.path())) {
                if (include.find("OpenImageIO") != std::string::npos &&
                    (knowing.empty() || knowing.back() != entry.path())) {
                    knowing.push_back(entry.path());
                }
            }
        }
    }
    EXPECT_EQ(knowing.size(), 1u);
}

} // namespace
