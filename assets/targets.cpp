#include "assets/targets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assets/cloth/draped_cloth.h"
#include "assets/cloth/knit.h"
#include "assets/cloth/woven_cloth.h"
#include "assets/head/statue_head.h"
#include "assets/letters/embossed_letters.h"
#include "engine/files/error.h"

namespace nacre {

namespace {

// A number that a target's specification may set.
struct TargetKey {
    std::string name;
    double least, largest; // both allowed
    double value;          // where it is not given
    bool whole;            // integers only
    std::string meaning;   // with its unit
};

// What makes a target's specification valid.
struct TargetGrammar {
    std::string name;
    std::string description;
    std::vector<std::string> words; // of which one may follow the name, the first where none does
    bool takesText = false;         // any word may follow; words.front() where none does
    std::vector<TargetKey> keys;
};

struct TargetArguments {
    std::string word; // empty where the grammar knows none
    std::map<std::string, double> numbers;

    double operator[](const std::string& key) const { return numbers.at(key); }
    int whole(const std::string& key) const { return static_cast<int>(numbers.at(key)); }
};

[[noreturn]] void refuse(const std::string& specification, const std::string& wrong, const std::string& expected)
{
    throw Error({}, fmt::format("target \"{}\": {}", specification, wrong), expected, Error::kUsage);
}

std::string describeKey(const TargetKey& key)
{
    return fmt::format("{}={} ({} to {}: {})", key.name, key.value, key.least, key.largest, key.meaning);
}

std::string describeKeys(const TargetGrammar& grammar)
{
    std::vector<std::string> keys;
    for (const TargetKey& key : grammar.keys) {
        keys.push_back(describeKey(key));
    }
    return keys.empty() ? fmt::format("{} has no keys", grammar.name) : fmt::format("{}", fmt::join(keys, ", "));
}

double parseValue(const std::string& specification, const TargetKey& key, const std::string& text)
{
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, value);
    const bool number = problem == std::errc() && stop == end;
    // Written so that NaN is refused too.
    if (!number || !(value >= key.least && value <= key.largest) || (key.whole && value != std::floor(value))) {
        refuse(specification, fmt::format("{}={} is not possible", key.name, text),
               fmt::format("{} {} from {} to {}", key.name, key.whole ? "is a whole number" : "is a number", key.least,
                           key.largest));
    }
    return value;
}

void parseField(const std::string& specification, const TargetGrammar& grammar, const std::string& field,
                TargetArguments& arguments)
{
    const size_t equals = field.find('=');
    if (equals == std::string::npos) {
        refuse(specification, fmt::format("\"{}\" is no KEY=NUMBER", field), describeKeys(grammar));
    }
    const auto key = std::find_if(grammar.keys.begin(), grammar.keys.end(),
                                  [&](const TargetKey& k) { return k.name == field.substr(0, equals); });
    if (key == grammar.keys.end()) {
        refuse(specification, fmt::format("{} knows no \"{}\"", grammar.name, field.substr(0, equals)),
               describeKeys(grammar));
    }
    arguments.numbers[key->name] = parseValue(specification, *key, field.substr(equals + 1));
}

std::string parseWord(const std::string& specification, const TargetGrammar& grammar, const std::string& word)
{
    const bool known = std::find(grammar.words.begin(), grammar.words.end(), word) != grammar.words.end();
    if (!known && !(grammar.takesText && !word.empty())) {
        refuse(specification, fmt::format("{} knows no \"{}\"", grammar.name, word),
               grammar.words.empty() ? "KEY=NUMBER: " + describeKeys(grammar)
                                     : fmt::format("{}", fmt::join(grammar.words, ", ")));
    }
    return word;
}

std::vector<std::string> splitAtCommas(const std::string& text)
{
    std::vector<std::string> fields;
    for (size_t first = 0; first <= text.size();) {
        const size_t comma = std::min(text.find(',', first), text.size());
        fields.push_back(text.substr(first, comma - first));
        first = comma + 1;
    }
    return fields;
}

// The part before ":" or ",".
std::string targetNameOf(const std::string& specification)
{
    return specification.substr(0, specification.find_first_of(":,"));
}

// Throws Error (usage).
TargetArguments parseTarget(const std::string& specification, const TargetGrammar& grammar)
{
    TargetArguments arguments;
    for (const TargetKey& key : grammar.keys) {
        arguments.numbers[key.name] = key.value;
    }
    arguments.word = grammar.words.empty() ? "" : grammar.words.front();
    const size_t nameEnd = targetNameOf(specification).size();
    if (nameEnd == specification.size()) {
        return arguments;
    }
    const std::vector<std::string> fields = splitAtCommas(specification.substr(nameEnd + 1));
    for (size_t i = 0; i < fields.size(); ++i) {
        const bool isWord = i == 0 && specification[nameEnd] == ':' && fields[i].find('=') == std::string::npos;
        if (isWord) {
            arguments.word = parseWord(specification, grammar, fields[i]);
        } else {
            parseField(specification, grammar, fields[i], arguments);
        }
    }
    return arguments;
}

// Description, words and keys on one line.
std::string describeGrammar(const TargetGrammar& grammar)
{
    std::string line = grammar.description;
    if (grammar.takesText) {
        line += fmt::format("; :TEXT, {} where none is given", grammar.words.front());
    } else if (!grammar.words.empty()) {
        line += fmt::format("; :{}", fmt::join(grammar.words, " :"));
    }
    return grammar.keys.empty() ? line : line + "; " + describeKeys(grammar);
}

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
