#pragma once
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/files/error.h"

namespace nacre {

// `body` has to throw Error with the exit code and a message of one line that holds every fragment.
template <typename Body>
void expectError(const Body& body, const std::vector<std::string>& fragments, int exitCode = Error::kData)
{
    try {
        body();
        ADD_FAILURE() << "no Error, expected one about " << (fragments.empty() ? "" : fragments[0]);
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(error.exitCode(), exitCode) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const std::string& fragment : fragments) {
            EXPECT_NE(message.find(fragment), std::string::npos) << "\"" << fragment << "\" is not in: " << message;
        }
    }
}

} // namespace nacre
