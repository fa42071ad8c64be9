#include "acquisition/normals/normals.h"

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

struct NamedMethod {
    const char* name;
    NormalMethod method;
};

constexpr NamedMethod kMethods[] = {
    {"auto", NormalMethod::automatic},      {"least-squares", NormalMethod::leastSquares},
    {"threshold", NormalMethod::threshold}, {"two-step", NormalMethod::twoStep},
    {"ransac", NormalMethod::ransac},       {"consensus", NormalMethod::consensus},
    {"exemplar", NormalMethod::exemplar}};

} // namespace

std::string normalMethodNames()
{
    std::string names;
    for (const NamedMethod& method : kMethods) {
        names += (names.empty() ? "" : ", ") + std::string(method.name);
    }
    return names;
}

NormalMethod normalMethodFromName(const std::string& name)
{
    for (const NamedMethod& method : kMethods) {
        if (name == method.name) {
            return method.method;
        }
    }
    throw Error("", fmt::format("--normals {} is no method", name), "one of " + normalMethodNames(), Error::kUsage);
}

std::string nameOf(NormalMethod method)
{
    for (const NamedMethod& named : kMethods) {
        if (named.method == method) {
            return named.name;
        }
    }
    return {};
}

} // namespace nacre
