#include "assets/target_specification.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/files/error.h"

namespace nacre {
namespace {

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

} // namespace

std::string targetNameOf(const std::string& specification)
{
    return specification.substr(0, specification.find_first_of(":,"));
}

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

} // namespace nacre
