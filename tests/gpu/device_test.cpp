// Choosing a device, its limits, and that validation is heard.
#include "engine/gpu/buffer.h"
#include "engine/gpu/renderer.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_error.h"

namespace nacre::test {
namespace {

using DeviceTest = GpuTest;

std::vector<DeviceInfo> threeDevices()
{
    return {{"Software Rasteriser", "d 1", "CPU", "1.3.0", "", ""},
            {"Old Card", "d 1", "discrete GPU", "1.1.0", "", "Vulkan 1.3"},
            {"New Card", "d 1", "integrated GPU", "1.3.0", "", ""}};
}

TEST(ChooseDevice, PrefersWhatWillDoAndIsFast)
{
    EXPECT_EQ(chooseDevice(threeDevices(), ""), 2u);
}

TEST(ChooseDevice, TakesNumbersAndPartsOfNames)
{
    EXPECT_EQ(chooseDevice(threeDevices(), "0"), 0u);
    EXPECT_EQ(chooseDevice(threeDevices(), "new"), 2u);
    EXPECT_EQ(chooseDevice(threeDevices(), "RASTER"), 0u);
}

TEST(ChooseDevice, SaysWhatIsThereWhenNothingFits)
{
    for (const char* selector : {"3", "-1", "radeon", "0x"}) {
        expectError([&] { chooseDevice(threeDevices(), selector); }, {selector, "2 = New Card"}, Error::kUsage);
    }
}

TEST(ChooseDevice, SaysWhatADeviceLacks)
{
    expectError([] { chooseDevice(threeDevices(), "old"); }, {"Old Card lacks Vulkan 1.3"});
}

TEST(ChooseDevice, SaysThatThereIsNone)
{
    expectError([] { chooseDevice({}, ""); }, {"no Vulkan device; install a driver, e.g. mesa-vulkan-drivers"});
}

TEST_F(DeviceTest, IsListed)
{
    const std::vector<DeviceInfo> devices = listDevices();
    ASSERT_FALSE(devices.empty());
    EXPECT_EQ(devices[chooseDevice(devices, deviceOfEnvironment())].name, context->info().name);
    EXPECT_FALSE(context->info().driver.empty());
    EXPECT_FALSE(context->info().limits.empty());
    EXPECT_EQ(context->info().apiVersion.substr(0, 2), "1.");
}

TEST_F(DeviceTest, RefusesPicturesBeyondItsLimits)
{
    const int limit = static_cast<int>(context->limits().maxImageDimension2D);
    EXPECT_NO_THROW(requirePictureSize(*context, limit, 1));
    for (const auto& [width, height] : {std::pair(limit + 1, 1), std::pair(1, limit + 1), std::pair(0, 5)}) {
        expectError([&] { requirePictureSize(*context, width, height); }, {"cannot draw", std::to_string(limit)});
    }
}

TEST_F(DeviceTest, RefusesPicturesBeyondItsMemory)
{
    const auto side = static_cast<int>(context->limits().maxImageDimension2D);
    const auto rows = static_cast<int>(context->largestAllocation() / sizeof(glm::vec4) / side);
    EXPECT_NO_THROW(requirePictureSize(*context, side, std::min(rows, side)));
    if (rows < side) {
        expectError([&] { requirePictureSize(*context, side, rows + 1); }, {"cannot draw", "million"});
    }
}

TEST_F(DeviceTest, RefusesTablesBeyondItsLimits)
{
    const int limit = static_cast<int>(context->limits().maxImageDimension3D);
    Scene scene = glossyScene(4, 4);
    scene.surface.materials[0].table = BrdfTable({limit + 1, 1, 1}, {kHalfDifference, kHalfPi});
    expectError([&] { Renderer(*context).render(scene); }, {"a table of", std::to_string(limit)});
}

// A check that the other tests' silence means something: a buffer of no bytes is against the rules.
TEST(Validation, IsHeard)
{
    setenv("NACRE_VALIDATION", "1", 1);
    const Context context;
    EXPECT_EQ(context.validationMessages(), 0);
    testing::internal::CaptureStderr();
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .pNext = nullptr,
                                  .flags = 0,
                                  .size = 0,
                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                  .queueFamilyIndexCount = 0,
                                  .pQueueFamilyIndices = nullptr};
    VkBuffer buffer = VK_NULL_HANDLE;
    if (vkCreateBuffer(context.device(), &info, nullptr, &buffer) == VK_SUCCESS) {
        vkDestroyBuffer(context.device(), buffer, nullptr);
    }
    EXPECT_GT(context.validationMessages(), 0);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("vulkan validation:"), std::string::npos);
}

// The same for what only the synchronization checks see: two copies into one place without a barrier between them.
TEST(Validation, HearsMissingBarriers)
{
    setenv("NACRE_VALIDATION", "1", 1);
    const Context context;
    const Buffer from(context, 64, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const Buffer into(context, 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    testing::internal::CaptureStderr();
    context.run([&](VkCommandBuffer commands) {
        const VkBufferCopy all{.srcOffset = 0, .dstOffset = 0, .size = 64};
        vkCmdCopyBuffer(commands, from.get(), into.get(), 1, &all);
        vkCmdCopyBuffer(commands, from.get(), into.get(), 1, &all);
    });
    EXPECT_GT(context.validationMessages(), 0);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos);
}

} // namespace
} // namespace nacre::test
