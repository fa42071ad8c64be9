#pragma once
#include <string>
#include <vector>

namespace nacre {

// The values of an option that takes several, each of which may be a list with commas. Values have commas of their own:
// numbers go on with the formula before them (lambert:0.5,0.2,0.1), key=number with the target (make:cloth,threads=32).
std::vector<std::string> listFromArguments(const std::vector<std::string>& texts);

// "0=A,1=B": an index and what belongs to it.
struct IndexedValue {
    size_t index = 0;
    std::string value;
};

// Throws Error (usage) that names the option.
std::vector<IndexedValue> indexedListFromArguments(const std::string& option, const std::vector<std::string>& texts);

} // namespace nacre
