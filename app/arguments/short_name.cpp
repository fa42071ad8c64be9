#include "app/arguments/short_name.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <map>

#include <fmt/format.h>

namespace nacre {

namespace {

// Without the folders, what every name of its kind starts with, and the extension of a file.
std::string essentialPart(const std::string& specification)
{
    constexpr std::array kPrefixes{"merl-abc:", "merl-sgd:", "make:"};
    for (const std::string_view prefix : kPrefixes) {
        if (specification.starts_with(prefix)) {
            return specification.substr(prefix.size());
        }
    }
    const size_t mark = specification.rfind('#');
    std::filesystem::path path = specification.substr(0, mark);
    if (!path.has_filename()) {
        path = path.parent_path(); // a slash at the end
    }
    // Points of numbers are no extensions.
    const bool isFormula = specification.find(':') != std::string::npos && !std::filesystem::exists(path);
    const std::string stem = isFormula ? path.string() : path.stem().string();
    return mark == std::string::npos ? stem : stem + "-" + specification.substr(mark + 1);
}

} // namespace

std::string shortName(const std::string& specification)
{
    std::string name = essentialPart(specification);
    for (char& c : name) {
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_') {
            c = '-';
        }
    }
    return name.empty() ? "unnamed" : name;
}

std::vector<std::string> shortNames(const std::vector<std::string>& specifications)
{
    std::map<std::string, int> taken;
    std::vector<std::string> names;
    for (const std::string& specification : specifications) {
        std::string name = shortName(specification);
        const int count = ++taken[name];
        if (count > 1) {
            name += fmt::format("-{}", count);
            ++taken[name];
        }
        names.push_back(name);
    }
    return names;
}

} // namespace nacre
