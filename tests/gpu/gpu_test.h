#pragma once
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "engine/gpu/context.h"

namespace nacre::test {

// Tests on one validated device; a message of the validation layer fails the test that caused it.
class GpuTest : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        setenv("NACRE_VALIDATION", "1", 1);
        context = std::make_unique<Context>();
    }
    static void TearDownTestSuite() { context.reset(); }

    void SetUp() override
    {
        ASSERT_TRUE(context->validates());
        messagesBefore_ = context->validationMessages();
    }
    void TearDown() override { EXPECT_EQ(context->validationMessages(), messagesBefore_) << "see stderr"; }

    static inline std::unique_ptr<Context> context;

private:
    int messagesBefore_ = 0;
};

} // namespace nacre::test
