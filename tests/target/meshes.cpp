#include "tests/target/meshes.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace nacre::test {

std::string sphereObj(int rings, bool withNormals, bool reversed)
{
    const int around = 2 * rings;
    std::string text = "o ball\n";
    for (int ring = 0; ring <= rings; ++ring) {
        for (int k = 0; k < around; ++k) {
            const double polar = glm::pi<double>() * ring / rings, azimuth = glm::two_pi<double>() * k / around;
            // All corners at a pole are at one place.
            const double radius = ring % rings == 0 ? 0 : std::sin(polar);
            const glm::dvec3 p(radius * std::sin(azimuth), std::cos(polar), radius * std::cos(azimuth));
            text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
            text += withNormals ? fmt::format("vn {} {} {}\n", p.x, p.y, p.z) : "";
        }
    }
    const auto corner = [&](int ring, int k) {
        const int index = ring * around + k % around + 1;
        return withNormals ? fmt::format("{}//{}", index, index) : fmt::format("{}", index);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int k = 0; k < around; ++k) {
            std::string a = corner(ring, k), b = corner(ring + 1, k), c = corner(ring + 1, k + 1),
                        d = corner(ring, k + 1);
            if (reversed) {
                std::swap(a, d), std::swap(b, c);
            }
            text += ring + 1 < rings ? fmt::format("f {} {} {}\n", a, b, c) : "";
            text += ring > 0 ? fmt::format("f {} {} {}\n", a, c, d) : "";
            // The last ring's upper triangles, the first one's lower: the others there have no area.
            text += ring + 1 == rings ? fmt::format("f {} {} {}\n", a, b, d) : "";
        }
    }
    return text;
}

std::string squareObj(int quarterTurns, bool mirrored, bool withUvs)
{
    constexpr int kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::string text = "o square\n";
    for (const auto& corner : kCorners) {
        text += fmt::format("v {} {} 0\nvn 0 0 1\n", 2 * corner[0] - 1, 2 * corner[1] - 1);
    }
    for (int k = 0; k < 4; ++k) {
        const auto& uv = kCorners[(k + quarterTurns) % 4];
        text += fmt::format("vt {} {}\n", mirrored ? 1 - uv[0] : uv[0], uv[1]);
    }
    return text + (withUvs ? "f 1/1/1 2/2/2 3/3/3 4/4/4\n" : "f 1//1 2//2 3//3 4//4\n");
}

} // namespace nacre::test
