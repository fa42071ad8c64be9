#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace nacre {

// The data of a page, each array in an element of its own, which the page's description names by its number.
class PageParts {
public:
    // `kind`: what it counts as in the list of bytes. `text`: base64. Answers the number.
    size_t add(const std::string& kind, std::string text);

    std::string elements() const;
    struct Share {
        std::string kind;
        size_t bytes = 0; // of the page's text
    };
    // In the order in which the kinds came.
    std::vector<Share> shares() const;

private:
    struct Part {
        std::string kind, text;
    };
    std::vector<Part> parts_;
};

} // namespace nacre
