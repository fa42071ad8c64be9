#include "acquisition/capture/picture_files.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// OpenImageIO's readers by extension, camera raw last; without the kinds that hold no photograph (fonts, video,
// volumes).
constexpr auto kPictureExtensions = std::to_array<std::string_view>(
    {".tga",  ".tpic",  ".png",  ".jpg",  ".jpe", ".jpeg", ".jp2",  ".j2k", ".j2c", ".tif", ".tiff", ".exr",
     ".hdr",  ".rgbe",  ".bmp",  ".dib",  ".pbm", ".pgm",  ".ppm",  ".pnm", ".pfm", ".psd", ".webp", ".heic",
     ".heif", ".heics", ".avif", ".dpx",  ".cin", ".dds",  ".fits", ".gif", ".ico", ".iff", ".z",    ".pic",
     ".rla",  ".sgi",   ".rgb",  ".rgba", ".bw",  ".3fr",  ".arw",  ".bay", ".cap", ".cr2", ".cr3",  ".crw",
     ".dc2",  ".dcr",   ".dcs",  ".dng",  ".drf", ".eip",  ".erf",  ".fff", ".iiq", ".k25", ".kc2",  ".kdc",
     ".mdc",  ".mef",   ".mos",  ".mrw",  ".nef", ".nrw",  ".orf",  ".pef", ".ptx", ".pxn", ".raf",  ".raw",
     ".rdc",  ".rw2",   ".rwl",  ".rwz",  ".sr2", ".srf",  ".srw",  ".x3f"});

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// The run of digits at the front, cut off `text`, without leading zeros.
std::string_view takeNumber(std::string_view& text)
{
    const size_t end = std::find_if_not(text.begin(), text.end(), isDigit) - text.begin();
    std::string_view number = text.substr(0, end);
    text.remove_prefix(end);
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    return number;
}

// Negative, 0 or positive.
int compareNaturally(std::string_view a, std::string_view b)
{
    while (!a.empty() && !b.empty()) {
        if (isDigit(a[0]) && isDigit(b[0])) {
            const std::string_view m = takeNumber(a);
            const std::string_view n = takeNumber(b);
            const int order = m.size() != n.size() ? (m.size() < n.size() ? -1 : 1) : m.compare(n);
            if (order != 0) {
                return order;
            }
        } else {
            if (lower(a[0]) != lower(b[0])) {
                return lower(a[0]) < lower(b[0]) ? -1 : 1;
            }
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return static_cast<int>(b.empty()) - static_cast<int>(a.empty());
}

struct NumberedName {
    std::string name;
    std::string part; // digits, or "mask"
};

std::optional<NumberedName> splitName(const fs::path& file)
{
    const fs::path stem = file.stem();
    const std::string part = lowerCase(stem.extension().string());
    if (part.size() < 2 || (part != ".mask" && !std::all_of(part.begin() + 1, part.end(), isDigit))) {
        return std::nullopt;
    }
    return NumberedName{stem.stem().string(), part.substr(1)};
}

void requireDistinctNumbers(const NumberedPictures& pictures)
{
    for (size_t i = 1; i < pictures.photographs.size(); ++i) {
        const fs::path& file = pictures.photographs[i];
        const fs::path& previous = pictures.photographs[i - 1];
        if (compareNaturally(splitName(previous)->part, splitName(file)->part) == 0) {
            throw Error(file, fmt::format("has the same number as {}", previous.filename().string()),
                        "one photograph of each number");
        }
    }
}

} // namespace

bool naturalLess(std::string_view a, std::string_view b)
{
    const int order = compareNaturally(a, b);
    return order != 0 ? order < 0 : a < b;
}

bool hasPictureExtension(const fs::path& file)
{
    const std::string extension = lowerCase(file.extension().string());
    return std::find(kPictureExtensions.begin(), kPictureExtensions.end(), extension) != kPictureExtensions.end();
}

bool isNamedMask(const fs::path& file)
{
    return hasPictureExtension(file) && lowerCase(file.stem().string()).find("mask") != std::string::npos;
}

std::vector<fs::path> picturesIn(const fs::path& folder)
{
    std::vector<fs::path> pictures;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const bool hidden = entry.path().filename().string().starts_with('.');
        if (!hidden && entry.is_regular_file() && hasPictureExtension(entry.path())) {
            pictures.push_back(entry.path());
        }
    }
    if (error) {
        throw Error(folder, "cannot be listed: " + error.message(), "a folder that may be read");
    }
    std::sort(pictures.begin(), pictures.end(), [](const fs::path& a, const fs::path& b) {
        return naturalLess(a.filename().string(), b.filename().string());
    });
    return pictures;
}

std::optional<NumberedPictures> findNumberedPictures(const fs::path& folder)
{
    std::map<std::string, NumberedPictures> named;
    for (const fs::path& file : picturesIn(folder)) {
        if (const auto split = splitName(file)) {
            NumberedPictures& pictures = named[lowerCase(split->name)];
            pictures.name = split->name;
            (split->part == "mask" ? pictures.masks : pictures.photographs).push_back(file);
        }
    }
    std::erase_if(named, [](const auto& entry) { return entry.second.photographs.empty(); });
    if (std::any_of(named.begin(), named.end(), [](const auto& entry) { return !entry.second.masks.empty(); })) {
        std::erase_if(named, [](const auto& entry) { return entry.second.masks.empty(); });
    }
    const bool areMasked = !named.empty() && !named.begin()->second.masks.empty();
    if (named.empty() || (named.size() > 1 && !areMasked)) {
        return std::nullopt;
    }
    if (named.size() > 1) {
        throw Error(folder,
                    fmt::format("holds the numbered photographs of {} names, {} and {} among them", named.size(),
                                named.begin()->second.name, named.rbegin()->second.name),
                    "one capture in a folder");
    }
    requireDistinctNumbers(named.begin()->second);
    return named.begin()->second;
}

} // namespace nacre
