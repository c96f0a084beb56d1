#include "base/free_memory.h"

#include <gmock/gmock.h>
#include <fstream>

#include "helpers.h"

namespace lfdsim {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

/// A made-up root folder: /proc and the folders of control groups.
class FreeMemoryTest : public testing::Test {
  protected:
    void write(const fs::path& file, const std::string& text) const {
        fs::create_directories((root / file).parent_path());
        std::ofstream(root / file) << text;
    }
    void SetUp() override { write("proc/meminfo", "MemTotal:  64000000 kB\nMemFree:  1000 kB\nMemAvailable:  16000000 kB\n"); }
    void version2(const std::string& own, const std::string& mounted = "/") const {
        write("proc/self/cgroup", "0::" + own + "\n");
        write("proc/self/mountinfo", "24 1 0:22 / / rw - ext4 /dev/sda rw\n31 24 0:26 " + mounted +
                                         " /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
    }
    double free() const { return free_memory(root).bytes; }

    const test::TemporaryFolder temporary;
    const fs::path root = temporary.path();
};

TEST_F(FreeMemoryTest, IsWhatTheMachineHasToSpare) {
    EXPECT_EQ(free(), 16000000. * 1024);
    EXPECT_EQ(free_memory(root).whose, "this machine has");
}

// Slurm, systemd and containers nest groups: each of them counts.
TEST_F(FreeMemoryTest, IsWhatEachGroupLeaves) {
    version2("/slurm/job 7/step");
    EXPECT_EQ(free(), 16000000. * 1024);
    const fs::path top = "sys/fs/cgroup";
    write(top / "slurm/job 7/step/memory.max", "max\n");
    write(top / "slurm/job 7/step/memory.current", "900000000\n");
    write(top / "slurm/job 7/memory.max", "3000000000\n");
    write(top / "slurm/job 7/memory.current", "1000000000\n");
    EXPECT_EQ(free(), 2e9);
    EXPECT_THAT(free_memory(root).whose, HasSubstr("/slurm/job 7 "));
    write(top / "slurm/job 7/memory.stat", "anon 5\ninactive_file 300000000\nactive_file 100000000\n");
    EXPECT_EQ(free(), 2.4e9);
    write(top / "slurm/memory.high", "5000000000\n");
    write(top / "slurm/memory.current", "4500000000\n");
    EXPECT_EQ(free(), 5e8);
    write(top / "memory.max", "100\n");
    write(top / "memory.current", "200\n");
    EXPECT_EQ(free(), 0);
}

// In a container the mounted group is the container's, and the process's path begins there or above.
TEST_F(FreeMemoryTest, KnowsContainers) {
    write("sys/fs/cgroup/memory.max", "2000000000\n");
    write("sys/fs/cgroup/sub/memory.max", "1000000000\n");
    for (const auto& [own, mounted, expected] :
         {std::tuple("/docker/abc", "/docker/abc", 2e9), std::tuple("/docker/abc/sub", "/docker/abc", 1e9),
          std::tuple("/", "/", 2e9), std::tuple("/sub", "/", 1e9), std::tuple("/../other", "/", 2e9),
          std::tuple("/elsewhere", "/docker/abc", 2e9)}) {
        version2(own, mounted);
        EXPECT_EQ(free(), expected) << own << " " << mounted;
    }
}

TEST_F(FreeMemoryTest, KnowsVersionOne) {
    write("proc/self/cgroup", "9:name=systemd:/\n5:cpu,memory:/user/1\n4:cpu:/\n0::/\n");
    write("proc/self/mountinfo",
          "34 31 0:31 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n"
          "35 31 0:32 / /sys/fs/cgroup/mem\\040ory rw,relatime - cgroup cgroup rw,cpu,memory\n");
    const fs::path top = "sys/fs/cgroup/mem ory";
    write(top / "user/1/memory.limit_in_bytes", "9223372036854771712\n");
    write(top / "user/1/memory.usage_in_bytes", "700000000\n");
    EXPECT_EQ(free(), 16000000. * 1024);
    write(top / "user/memory.limit_in_bytes", "4000000000\n");
    write(top / "user/memory.usage_in_bytes", "3900000000\n");
    write(top / "user/memory.stat", "inactive_file 1\ntotal_inactive_file 900000000\n");
    EXPECT_EQ(free(), 1e9);
}

// Files that are missing, empty or of another kind limit nothing.
TEST_F(FreeMemoryTest, BearsWhatItCannotRead) {
    version2("/a");
    write("sys/fs/cgroup/a/memory.max", "");
    write("sys/fs/cgroup/memory.max", "none of your business");
    EXPECT_EQ(free(), 16000000. * 1024);
    write("proc/self/mountinfo", "nonsense\n\n1 2 3\n");
    write("proc/self/cgroup", "nonsense\n:\n::\n");
    EXPECT_EQ(free(), 16000000. * 1024);
    fs::remove_all(root / "proc");
    EXPECT_GT(free(), 1e8);
}

}  // namespace
}  // namespace lfdsim
