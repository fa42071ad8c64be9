#pragma once
#include <map>
#include <string>
#include <vector>

namespace nacre {

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

// The part before ":" or ",".
std::string targetNameOf(const std::string& specification);
// Throws Error (usage).
TargetArguments parseTarget(const std::string& specification, const TargetGrammar& grammar);
// Description, words and keys on one line.
std::string describeGrammar(const TargetGrammar& grammar);

} // namespace nacre
