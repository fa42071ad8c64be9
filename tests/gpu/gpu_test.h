#pragma once
#include <cstdlib>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/gpu/context.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/scene.h"

namespace nacre::test {

inline std::string typeOfTestedDevice; // as DeviceInfo has it

// Tests on one validated device; a message of the validation layer fails the test that caused it. Where there is no
// device they fail and say why: a renderer whose tests were skipped has not been tested.
class GpuTest : public testing::Test {
protected:
    static void SetUpTestSuite() { open({}); }
    static void TearDownTestSuite()
    {
        // What is left over is only heard when the device goes, after the last test.
        testing::internal::CaptureStderr();
        context.reset();
        const std::string heard = testing::internal::GetCapturedStderr();
        EXPECT_EQ(heard.find("vulkan validation:"), std::string::npos) << heard;
    }

    // `selector` as --device has it.
    static void open(const std::string& selector)
    {
        setenv("NACRE_VALIDATION", "1", 1);
        try {
            context = std::make_unique<Context>(selector);
            typeOfTestedDevice = context->info().type;
        } catch (const Error& error) {
            whyNoContext_ = error.what();
        }
    }

    void SetUp() override
    {
        ASSERT_TRUE(context) << whyNoContext_;
        ASSERT_TRUE(context->validates());
        messagesBefore_ = context->validationMessages();
    }
    void TearDown() override
    {
        EXPECT_FALSE(IsSkipped()) << "tests of the renderer run or fail";
        if (context) {
            EXPECT_EQ(context->validationMessages(), messagesBefore_) << "see stderr";
        }
    }

    static Renderer rendererOf(const Scene& scene, RenderPath path, VkDeviceSize cacheBytes = Renderer::kCacheBytes)
    {
        Renderer renderer(*context, cacheBytes);
        renderer.setSurface(scene.surface);
        renderer.setLights(scene.lights);
        renderer.setView(scene.view);
        renderer.setPath(path);
        return renderer;
    }

    static inline std::unique_ptr<Context> context;

private:
    static inline std::string whyNoContext_;
    int messagesBefore_ = 0;
};

} // namespace nacre::test
