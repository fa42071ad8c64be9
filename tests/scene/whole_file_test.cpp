// What a written file replaces and what it leaves alone; more of the same is in tests/app/outputs_test.cpp.
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/files/whole_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

TEST(WholeFile, IsWrittenThroughLinks)
{
    const TempFolder folder;
    writeText(folder / "below/old.txt", "old");
    fs::create_symlink("below/old.txt", folder / "link.txt");
    fs::create_symlink("below/new.txt", folder / "dangling.txt");
    writeTextFile(folder / "link.txt", "1");
    writeTextFile(folder / "dangling.txt", "2");
    EXPECT_EQ(fs::read_symlink(folder / "link.txt"), "below/old.txt");
    EXPECT_EQ(readTextFile(folder / "below/old.txt"), "1");
    EXPECT_EQ(fs::read_symlink(folder / "dangling.txt"), "below/new.txt");
    EXPECT_EQ(readTextFile(folder / "below/new.txt"), "2");
    fs::create_symlink("round.txt", folder / "round.txt");
    expectError([&] { writeTextFile(folder / "round.txt", "3"); }, {"round.txt", "leads back to itself"});
}

TEST(WholeFile, IsWrittenThroughPipesAndDevices)
{
    const TempFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] { read = readTextFile(pipe); });
    writeTextFile(pipe, "text");
    EXPECT_TRUE(fs::is_fifo(pipe));
    if (!fs::is_fifo(pipe)) {
        std::ofstream unblocked(pipe);
    }
    reader.join();
    EXPECT_EQ(read, "text");
    writeTextFile("/dev/null", "text");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    expectError([] { writeTextFile("/dev/full", "text"); }, {"/dev/full", "No space left"});
}

TEST(WholeFile, DoesNotTakeTheOtherKindsPlace)
{
    const TempFolder folder;
    writeText(folder / "a/b", "kept");
    expectError([&] { writeTextFile(folder / "a", "text"); }, {"is a folder"});
    EXPECT_EQ(readTextFile(folder / "a/b"), "kept");
    WholeOutput output(folder / "a/b", true);
    fs::create_directory(output.temporary());
    expectError([&] { output.commit(); }, {"is no folder"});
    EXPECT_EQ(readTextFile(folder / "a/b"), "kept");
}

// In a process of its own, which a signal ends.
TEST(Unfinished, IsRemovedBySignals)
{
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        const TempFolder folder;
        int ready[2];
        ASSERT_EQ(pipe(ready), 0);
        const pid_t child = fork();
        if (child == 0) {
            removeUnfinishedOnSignals();
            const Unfinished part(folder / "part");
            writeText(part.path() / "below/file", "text");
            const char done = 1;
            _exit(write(ready[1], &done, 1) == 1 ? (pause(), 0) : 1);
        }
        char done = 0;
        EXPECT_EQ(::read(ready[0], &done, 1), 1);
        EXPECT_TRUE(fs::exists(folder / "part/below/file"));
        kill(child, signal);
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
        EXPECT_TRUE(fs::is_empty(folder.path()));
        close(ready[0]);
        close(ready[1]);
    }
}

} // namespace
} // namespace nacre
