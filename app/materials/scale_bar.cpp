#include "app/materials/scale_bar.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr double kMostOfWidth = 0.25;
constexpr int kLettersOfHeight = 30, kSmallestLetters = 12; // letters are a thirtieth of the picture high
constexpr int kSmallestSide = 64;

void fill(Image& picture, int left, int top, int width, int height, float code)
{
    for (int y = top; y < top + height; ++y) {
        for (int x = left; x < left + width; ++x) {
            picture.setRgb(x, y, glm::vec3(code));
        }
    }
}

std::string nameOf(double millimetres)
{
    return millimetres < 1000 ? fmt::format("{:g} mm", millimetres) : fmt::format("{:g} m", millimetres / 1000);
}

} // namespace

double scaleBarLength(int width, double pixelsPerMillimetre)
{
    const double most = kMostOfWidth * width / pixelsPerMillimetre, decade = std::pow(10, std::floor(std::log10(most)));
    const double share = most / decade;
    return decade * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

void drawScaleBar(Image& picture, double pixelsPerMillimetre)
{
    if (std::min(picture.width, picture.height) < kSmallestSide) {
        throw Error("", fmt::format("--scale-bar does not fit into {}x{} pixels", picture.width, picture.height),
                    fmt::format("{} on each side", kSmallestSide), Error::kUsage);
    }
    const double millimetres = scaleBarLength(picture.width, pixelsPerMillimetre);
    const int bar = static_cast<int>(std::lround(millimetres * pixelsPerMillimetre));
    const int letters = std::max(picture.height / kLettersOfHeight, kSmallestLetters), gap = letters / 2;
    const std::string name = nameOf(millimetres);
    const int plateWidth =
        std::min(std::max(bar, static_cast<int>(name.size()) * letters * 2 / 3) + 2 * gap, picture.width);
    const int plateHeight = letters + letters / 4 + 3 * gap, top = picture.height - plateHeight;
    fill(picture, 0, top, plateWidth, plateHeight, 0);
    fill(picture, gap, picture.height - gap - letters / 4, bar, letters / 4, 1);
    if (!drawText(picture, gap, top + gap + letters * 4 / 5, name, letters)) {
        throw Error("", "no font is installed for --scale-bar", "the package fonts-dejavu-core");
    }
}

} // namespace nacre
