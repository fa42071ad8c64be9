#include "engine/view_state/recent_files.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"

namespace nacre {
namespace {

TEST(RecentFilesTest, TheNewestComesFirstAndOnce)
{
    const TemporaryFolder folder;
    const std::filesystem::path list = folder.path() / "state/nacre/recent";
    RecentFiles recent(list);
    for (int i = 0; i < 12; ++i) {
        recent.note("/" + std::to_string(i) + ".nacre");
    }
    recent.note("/a/../8.nacre/");
    recent.note("/8.nacre");
    const RecentFiles read(list);
    EXPECT_EQ(read.files(), recent.files());
    ASSERT_EQ(read.files().size(), RecentFiles::kMost);
    EXPECT_EQ(read.files()[0], "/8.nacre");
    EXPECT_EQ(read.files()[1], "/11.nacre");
}

TEST(RecentFilesTest, TwoWindowsKeepWhatTheOtherHasOpened)
{
    const TemporaryFolder folder;
    RecentFiles one(folder.path() / "recent"), other(folder.path() / "recent");
    one.note("/one.nacre");
    other.note("/other.nacre");
    EXPECT_EQ(RecentFiles(folder.path() / "recent").files(),
              (std::vector<std::filesystem::path>{"/other.nacre", "/one.nacre"}));
}

TEST(RecentFilesTest, AListThatIsNoneIsEmpty)
{
    const TemporaryFolder folder;
    writeTextFile(folder.path() / "recent", std::string("\0\xff\nnot/absolute\n\n", 16));
    EXPECT_TRUE(RecentFiles(folder.path() / "recent").files().empty());
    RecentFiles nowhere({});
    nowhere.note("/a.nacre");
    EXPECT_TRUE(nowhere.files().empty());
    RecentFiles unwritable(folder.path() / "recent" / "below a file");
    unwritable.note("/a.nacre");
    EXPECT_EQ(unwritable.files().size(), 1u) << "of this window";
}

} // namespace
} // namespace nacre
