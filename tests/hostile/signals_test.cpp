#include <csignal>
#include <sys/stat.h>

#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

using std::chrono::milliseconds;

/// Signals that ask for an end, at many moments of a run.
class Signals : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
        RasterSpec spec = one_block();
        spec.rows = spec.cols = 900;
        spec.values.clear();
        for (int row = 0; row < 900; ++row)
            for (int col = 0; col < 900; ++col)
                spec.values.push_back(row % 30 < 14 && col % 30 < 17 ? 12 + (row * 7 + col * 3) % 5 * 0.1
                                                                     : 0);
        write(path("dem.tif"), spec);
        run_well({"-q", "dem.tif", "whole.gpkg"});
        whole_ = count("whole.gpkg");
        ASSERT_GT(whole_, 800);
    }
    /// Either the signal came in time and nothing has changed, or it came too late and all is there.
    /// @return whether it came in time
    bool ended(int signal, milliseconds after, const std::string& destination, int before) const {
        const auto names = entries();
        const ToolResult result = run({"-q", "-overwrite", "-write_ground", "ground.tif", "-surface",
                                       "city.city.json", "-surface", "city.glb", "dem.tif", destination},
                                      {.kill = Kill{signal, after}});
        const bool in_time = result.status == 128 + signal;
        EXPECT_TRUE(in_time || result.status == 0) << result.status << result.err;
        if (in_time) {
            // Before the handler stands, the signal ends the process without a word.
            EXPECT_TRUE(result.err == "ERROR: Cancelled; nothing was written.\n" || result.err.empty())
                << result.err;
            EXPECT_EQ(entries(), names);
        }
        const int now = std::filesystem::exists(path(destination)) ? count(destination) : -1;
        EXPECT_EQ(now, in_time ? before : whole_) << after.count();
        for (const char* beside : {"ground.tif", "city.city.json", "city.glb"})
            std::filesystem::remove(path(beside));
        return in_time;
    }
    [[nodiscard]] int count(const std::string& file) const {
        return std::stoi(sql_value(path(file), "SELECT count(*) FROM buildings"));
    }
    int whole_ = 0;  ///< buildings, where nothing disturbs
};

TEST_F(Signals, leaveNothingNew) {
    int in_time = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        for (int after = 1; after < 400; after += 57) {
            in_time += ended(signal, milliseconds(after), "out.gpkg", -1) ? 1 : 0;
            std::filesystem::remove(path("out.gpkg"));
        }
    EXPECT_GE(in_time, 3);
}

TEST_F(Signals, leaveTheOldContent) {
    write(path("small.tif"), one_block());
    for (const int signal : {SIGINT, SIGTERM})
        for (int after = 20; after < 400; after += 83) {
            run_well({"-q", "-overwrite", "small.tif", "old.gpkg"});
            static_cast<void>(ended(signal, milliseconds(after), "old.gpkg", 1));
            EXPECT_EQ(sql_value(path("old.gpkg"), "PRAGMA integrity_check"), "ok");
        }
}

TEST_F(Signals, breakOffAReadThatWaits) {
    // A pipe whose other end is held open and silent.
    const std::string fifo = path("pipe");
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    const std::string script = "exec 3<>pipe; exec \"$0\" -q /vsistdin/ out.gpkg <pipe";
    const std::string scratch = path("scratch");
    std::filesystem::create_directory(scratch);
    ToolResult result;
    // Before the handler stands, the signal ends the program without a word; a busy machine takes its time.
    for (int after = 700; after < 10000 && result.err.empty(); after *= 3)
        result = run_tool({"sh", "-c", script, D2B_TOOL}, {.environment = {"CPL_TMPDIR=" + scratch},
                                                           .working_directory = folder_.string(),
                                                           .kill = Kill{SIGTERM, milliseconds(after)}});
    EXPECT_EQ(result.status, 143);
    EXPECT_EQ(result.err, "ERROR: Cancelled; nothing was written.\n");
    EXPECT_TRUE(std::filesystem::is_empty(scratch));
    EXPECT_FALSE(std::filesystem::exists(path("out.gpkg")));
}

TEST_F(Signals, thatAreSetAsideStayAside) {
    const ToolResult result =
        run_tool({"sh", "-c", "trap '' HUP; exec \"$0\" -q dem.tif out.gpkg", D2B_TOOL},
                 {.working_directory = folder_.string(), .kill = Kill{SIGHUP, milliseconds(100)}});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(count("out.gpkg"), whole_);
}

}  // namespace
}  // namespace d2b::test
