#include "assets/targets.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "assets/cloth/draped_cloth.h"
#include "assets/cloth/knit.h"
#include "assets/cloth/weave_pattern.h"
#include "assets/cloth/woven_cloth.h"
#include "assets/head/statue_head.h"
#include "assets/letters/embossed_letters.h"
#include "assets/target_specification.h"
#include "engine/files/error.h"

namespace nacre {
namespace {

struct PictureShape {
    int width, height; // pixels
    int threads;       // 0 = all
};

struct Maker {
    TargetGrammar grammar;
    std::function<Target(const TargetArguments&, const PictureShape&)> make;
};

Target makeSphere(const TargetArguments&, const PictureShape& shape)
{
    const int size = std::min(shape.width, shape.height);
    Target target(shape.width, shape.height, {"sphere"});
    target.normals = fittedNormalMap(sphereNormalMap(size), shape.width, shape.height);
    for (size_t i = 0; i < target.labels.size(); ++i) {
        if (target.normals.confidence[i] > 0) {
            target.height.values[i] = 0.5f * static_cast<float>(size - 1) * target.normals.normals[i].z;
            target.labels[i] = 0;
        }
    }
    return target;
}

Target makeHead(const TargetArguments& arguments, const PictureShape& shape)
{
    StatueHeadOptions options;
    options.turnDegrees = arguments["turn"];
    options.bowDegrees = arguments["bow"];
    return statueHead(shape.width, shape.height, options, shape.threads);
}

Target makeCloth(const TargetArguments& arguments, const PictureShape& shape)
{
    WovenClothOptions options;
    options.weave = arguments.word;
    options.threads = arguments.whole("threads");
    options.curl = arguments["curl"];
    options.drape = arguments["drape"];
    options.wander = arguments["wander"];
    options.seed = static_cast<uint64_t>(arguments["seed"]);
    return wovenCloth(shape.width, shape.height, options, shape.threads);
}

Target makeKnit(const TargetArguments& arguments, const PictureShape& shape)
{
    KnitOptions options;
    options.loops = arguments.whole("loops");
    options.curl = arguments["curl"];
    options.drape = arguments["drape"];
    options.wander = arguments["wander"];
    options.stripes = arguments.whole("stripes");
    options.seed = static_cast<uint64_t>(arguments["seed"]);
    return knit(shape.width, shape.height, options, shape.threads);
}

Target makeLetters(const TargetArguments& arguments, const PictureShape& shape)
{
    EmbossedLettersOptions options;
    options.text = arguments.word;
    options.stroke = arguments["stroke"];
    options.bevel = arguments["bevel"];
    options.relief = arguments["relief"];
    options.roughness = arguments["roughness"];
    options.seed = static_cast<uint64_t>(arguments["seed"]);
    return embossedLetters(shape.width, shape.height, options, shape.threads);
}

Target makeDrape(const TargetArguments& arguments, const PictureShape& shape)
{
    DrapedClothOptions options;
    options.way = arguments.word;
    options.stiffness = arguments["stiffness"];
    options.seed = static_cast<uint64_t>(arguments["seed"]);
    return drapedCloth(shape.width, shape.height, options, shape.threads);
}

const TargetKey kSeedKey{"seed", 0, 1e6, 1, true, "of its irregularities"};

const std::vector<Maker>& makers()
{
    static const std::vector<Maker> kMakers = {
        {{"sphere", "the reference ball's own surface", {}, false, {}}, makeSphere},
        {{"cloth",
          "a weave of upright warp and level weft",
          weaveNames(),
          false,
          {{"threads", 4, 200, 32, true, "yarns across the shorter side"},
           {"curl", 0, 1, 0.5, false, "tangent of the yarns' twist angle"},
           {"drape", 0, 1, 0.35, false, "slope of the folds"},
           {"wander", 0, 2, 1, false, "irregularity of the yarns"},
           kSeedKey}},
         makeCloth},
        {{"knit",
          "stockinette in two yarns, seen from its face",
          {},
          false,
          {{"loops", 3, 100, 18, true, "across the shorter side"},
           {"curl", 0, 1, 0.5, false, "tangent of the yarn's twist angle"},
           {"drape", 0, 1, 0.25, false, "slope of the folds"},
           {"wander", 0, 2, 1, false, "irregularity of the loops"},
           {"stripes", 1, 100, 4, true, "courses of one yarn"},
           kSeedKey}},
         makeKnit},
        {{"drape",
          "a large sheet that has fallen",
          drapeNames(),
          false,
          {{"stiffness", 0, 1, 0.1, false, "0 is limp"}, kSeedKey}},
         makeDrape},
        {{"letters",
          "a plate of embossed letters, / ends a line",
          {"NACRE"},
          true,
          {{"stroke", 0.05, 0.4, 0.24, false, "breadth over the letters' height"},
           {"bevel", 0.1, 1, 0.6, false, "share of the stroke that slopes"},
           {"relief", 0, 0.5, 0.13, false, "rise over the letters' height"},
           {"roughness", 0, 5, 1, false, "unevenness of the cast"},
           kSeedKey}},
         makeLetters},
        {{"head",
          "a carved bust in the antique manner",
          {},
          false,
          {{"turn", -40, 40, 24, false, "degrees about the vertical, towards the picture's right"},
           {"bow", -15, 15, 5, false, "degrees forward"}}},
         makeHead},
    };
    return kMakers;
}

std::string listedNames()
{
    std::string names;
    for (const Maker& maker : makers()) {
        names += (names.empty() ? "" : ", ") + maker.grammar.name;
    }
    return names;
}

} // namespace

Target makeTarget(const std::string& specification, int width, int height, int threads)
{
    if (width < 2 || height < 2) {
        throw Error({}, fmt::format("a target of {}x{} pixels is too small", width, height), "at least 2x2",
                    Error::kUsage);
    }
    for (const Maker& maker : makers()) {
        if (maker.grammar.name == targetNameOf(specification)) {
            return maker.make(parseTarget(specification, maker.grammar), {width, height, threads});
        }
    }
    throw Error({}, fmt::format("there is no target \"{}\"", specification), listedNames(), Error::kUsage);
}

std::vector<TargetName> targetNames()
{
    std::vector<TargetName> names;
    for (const Maker& maker : makers()) {
        names.push_back({maker.grammar.name, describeGrammar(maker.grammar)});
    }
    return names;
}

} // namespace nacre
