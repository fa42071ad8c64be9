// The arrows of docs/architecture.md, read from the include lines: what a folder may not know, its files may not
// include.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;

constexpr size_t kMostPairs = 25; // headers and sources of one name, in one folder

// The longest folder that a file lies in has its rule: a new folder of the engine knows no Vulkan.
struct Rule {
    const char* folder;
    std::vector<const char*> forbidden;
};

const Rule kRules[] = {
    {"shaders/shared", {"engine/", "acquisition/", "assets/", "evaluation/", "app/", "OpenImageIO", "vulkan", "Eigen"}},
    {"engine",
     {"vulkan", "GLFW", "imgui", "Eigen", "nanoflann", "assimp", "engine/gpu", "engine/target", "engine/loading",
      "engine/viewer", "acquisition/", "assets/", "evaluation/", "app/"}},
    {"engine/gpu",
     {"GLFW", "imgui", "Eigen", "nanoflann", "assimp", "engine/target", "engine/loading", "engine/viewer",
      "acquisition/", "assets/", "evaluation/", "app/"}},
    {"engine/target",
     {"GLFW", "imgui", "Eigen", "nanoflann", "engine/loading", "engine/viewer", "acquisition/", "assets/",
      "evaluation/", "app/"}},
    {"engine/loading",
     {"vulkan", "GLFW", "imgui", "Eigen", "nanoflann", "assimp", "engine/viewer", "acquisition/", "assets/",
      "evaluation/", "app/"}},
    {"engine/viewer", {"Eigen", "nanoflann", "assimp", "acquisition/", "assets/", "evaluation/", "app/"}},
    {"acquisition",
     {"vulkan", "GLFW", "imgui", "assimp", "engine/gpu", "engine/target", "engine/loading", "engine/viewer", "assets/",
      "evaluation/", "app/"}},
    {"assets",
     {"vulkan", "GLFW", "imgui", "Eigen", "assimp", "engine/gpu", "engine/target", "engine/loading", "engine/viewer",
      "acquisition/", "evaluation/", "app/"}},
    {"evaluation", {"vulkan", "GLFW", "imgui", "assimp", "engine/viewer", "app/"}},
    {"app", {"vulkan", "GLFW", "imgui", "Eigen", "nanoflann", "assimp"}},
};

struct Source {
    std::string path; // from the root of the sources
    std::string folder;
    std::vector<std::string> includes; // the names between quotes or brackets
};

std::vector<std::string> includesOf(const fs::path& file)
{
    std::vector<std::string> includes;
    std::ifstream stream(file);
    const std::string word = "#include ";
    for (std::string line; std::getline(stream, line);) {
        const size_t end = line.find_first_of("\">", word.size() + 1);
        if (line.starts_with(word) && end != std::string::npos) {
            includes.push_back(line.substr(word.size() + 1, end - word.size() - 1));
        }
    }
    return includes;
}

const std::vector<Source>& sources()
{
    static const std::vector<Source> all = [] {
        std::vector<Source> found;
        const fs::path root = NACRE_SOURCE_DIR;
        for (const char* part : {"shaders/shared", "engine", "acquisition", "assets", "evaluation", "app"}) {
            for (const auto& entry : fs::recursive_directory_iterator(root / part)) {
                const fs::path file = entry.path().lexically_relative(root);
                if (file.extension() == ".h" || file.extension() == ".cpp") {
                    found.push_back({file.string(), file.parent_path().string(), includesOf(entry.path())});
                }
            }
        }
        return found;
    }();
    return all;
}

const Rule& ruleOf(const std::string& folder)
{
    const Rule* found = nullptr;
    for (const Rule& rule : kRules) {
        if ((folder + "/").starts_with(std::string(rule.folder) + "/") &&
            (!found || std::string(rule.folder).size() > std::string(found->folder).size())) {
            found = &rule;
        }
    }
    return *found;
}

// By folder, the folders that its files include, and one include as the reason.
std::map<std::string, std::map<std::string, std::string>> arrows()
{
    std::map<std::string, std::map<std::string, std::string>> found;
    for (const Source& source : sources()) {
        for (const std::string& include : source.includes) {
            const std::string to = fs::path(include).parent_path().string();
            if (to != source.folder && fs::exists(fs::path(NACRE_SOURCE_DIR) / include)) {
                found[source.folder].emplace(to, source.path + " includes " + include);
            }
        }
    }
    return found;
}

TEST(Architecture, NoFolderIncludesWhatItMayNotKnow)
{
    size_t seen = 0;
    for (const Source& source : sources()) {
        for (const std::string& include : source.includes) {
            ++seen;
            for (const char* word : ruleOf(source.folder).forbidden) {
                EXPECT_EQ(include.find(word), std::string::npos) << source.path << " includes " << include;
            }
        }
    }
    EXPECT_GT(seen, 1000u) << "the sources were not found";
}

TEST(Architecture, OneFileKnowsOpenImageIO)
{
    std::set<std::string> knowing;
    for (const Source& source : sources()) {
        for (const std::string& include : source.includes) {
            if (include.starts_with("OpenImageIO/")) {
                knowing.insert(source.path);
            }
        }
    }
    EXPECT_EQ(knowing.size(), 1u) << fmt::format("{}", knowing);
}

// Folders that include no other go, and those that no other includes, until none is left: what stays is circles, and
// what lies between two.
TEST(Architecture, NoFoldersIncludeEachOtherInACircle)
{
    auto left = arrows();
    EXPECT_GT(left.size(), 20u) << "the sources were not found";
    const auto isAnEnd = [&](const auto& folder) {
        const auto isLeft = [&](const auto& to) { return left.contains(to.first); };
        const auto includesIt = [&](const auto& other) { return other.second.contains(folder.first); };
        return std::ranges::none_of(folder.second, isLeft) || std::ranges::none_of(left, includesIt);
    };
    for (auto end = std::ranges::find_if(left, isAnEnd); end != left.end(); end = std::ranges::find_if(left, isAnEnd)) {
        left.erase(end);
    }
    for (const auto& [folder, tos] : left) {
        for (const auto& [to, reason] : tos) {
            if (left.contains(to)) {
                ADD_FAILURE() << folder << " -> " << to << ": " << reason;
            }
        }
    }
}

// A name with a folder says the whole way from the root; one without is a shared shader's or generated from a shader.
TEST(Architecture, HeadersAreNamedFromTheRoot)
{
    for (const Source& source : sources()) {
        for (const std::string& include : source.includes) {
            EXPECT_EQ(include.find(".."), std::string::npos) << source.path << " includes " << include;
            const bool alone = fs::path(include).parent_path().empty();
            const bool isNeighbour = alone && fs::exists(fs::path(NACRE_SOURCE_DIR) / source.folder / include);
            EXPECT_TRUE(!isNeighbour || source.folder == "shaders/shared") << source.path << " includes " << include;
        }
    }
}

TEST(Architecture, NoFolderHoldsMoreThanTheEyeTakesIn)
{
    std::map<std::string, std::set<std::string>> pairs;
    for (const Source& source : sources()) {
        pairs[source.folder].insert(fs::path(source.path).stem().string());
    }
    for (const auto& [folder, names] : pairs) {
        EXPECT_LE(names.size(), kMostPairs) << folder;
    }
}

} // namespace
