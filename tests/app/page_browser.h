#pragma once
#include <string>
#include <vector>

#include "engine/files/image.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {

// What the page shows behind an address, and what it should show.
struct PageState {
    std::string hash;
    Image expected;
};

// A page in a frame so wide, and where it is taken to.
struct PageFrame {
    std::string name; // of what is said about it
    std::string file;
    int width = 0;
    std::vector<PageState> states;
};

// A document that opens all pages, takes them to each state, and to the first again after the context was lost, and
// writes the canvas's pixels into itself; then what gestures do, and more that pages say of themselves.
std::string harness(const std::vector<PageFrame>& frames);

bool hasBrowser();
// The document of a file of the folder, as a browser dumps it once it is loaded.
ProgramRun browse(const TempFolder& folder, const std::string& file);

// What stands between a mark and " end" in a dumped document; empty where it is missing.
std::string saidBehind(const std::string& document, const std::string& mark);
// The state's number is the end of `name`.
Image shownPicture(const std::string& document, const std::string& name, const TempFolder& folder);

} // namespace nacre::test
