#include <chrono>
#include <cstdlib>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

#include "faults/faulty_case.hpp"

namespace d2b::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Another process that has a GeoPackage open in WAL mode, as QGIS does.
class Watcher {
  public:
    explicit Watcher(const std::string& path) {
        EXPECT_EQ(::pipe(pipe_.data()), 0);
        std::array<int, 2> ready{};
        EXPECT_EQ(::pipe(ready.data()), 0);
        child_ = ::fork();
        if (child_ == 0) {
            ::close(pipe_[1]);
            GDALDatasetH dataset =
                GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
            for (const char* statement : {"PRAGMA journal_mode = WAL", "SELECT count(*) FROM mine"})
                GDALDatasetReleaseResultSet(dataset,
                                            GDALDatasetExecuteSQL(dataset, statement, nullptr, nullptr));
            char byte = 0;
            static_cast<void>(!::write(ready[1], &byte, 1));
            static_cast<void>(!::read(pipe_[0], &byte, 1));
            ::_exit(0);  // as a crash would: nothing is put in order
        }
        char byte = 0;
        EXPECT_EQ(::read(ready[0], &byte, 1), 1);
        ::close(ready[0]);
        ::close(ready[1]);
    }
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;
    ~Watcher() {
        ::close(pipe_[1]);
        ::waitpid(child_, nullptr, 0);
        ::close(pipe_[0]);
    }

  private:
    std::array<int, 2> pipe_{};
    pid_t child_ = 0;
};

class Killed : public FaultyTest {
  protected:
    static int times() {
        const char* wanted = std::getenv("D2B_KILLS");
        return wanted == nullptr ? 10 : std::atoi(wanted);
    }
    /// Some more where the machine has become faster since a run was timed, and runs end before their kill.
    static bool goes_on(int i, int killed) {
        return i < times() || (killed <= times() / 4 && i < 5 * times());
    }
    /// How long a run takes that nobody disturbs.
    milliseconds duration(const std::string& destination) const {
        const auto start = Clock::now();
        run_well({"-q", "-overwrite", "dem.tif", destination});
        return std::chrono::duration_cast<milliseconds>(Clock::now() - start);
    }
    /// Half of the moments are in the last third of a run, when files change.
    milliseconds moment(milliseconds whole) {
        const auto per_mille = random_() % 2 == 0 ? random_() % 1050 : 600 + random_() % 450;
        return whole * per_mille / 1000;
    }
    int run_killed(const std::string& destination, milliseconds after) const {
        return run({"-q", "-overwrite", "dem.tif", destination}, {.kill = Kill{SIGKILL, after}}).status;
    }
    /// ogrinfo takes it, and SQLite finds nothing wrong.
    void expect_sound(const std::string& name) const {
        const ToolResult seen = run_tool({"ogrinfo", "-al", "-q", path(name)});
        EXPECT_EQ(seen.status, 0);
        EXPECT_EQ(seen.err, "");
        EXPECT_EQ(sql_value(path(name), "PRAGMA integrity_check"), "ok");
    }
    std::mt19937 random_{7};
};

TEST_F(Killed, aNewFileIsThereWholeOrNotAtAll) {
    const milliseconds whole = duration("out.gpkg");
    const int all = features("out.gpkg");
    int killed = 0;
    for (int i = 0; goes_on(i, killed); ++i) {
        std::filesystem::remove(path("out.gpkg"));
        const int status = run_killed("out.gpkg", moment(whole));
        killed += status == 128 + SIGKILL ? 1 : 0;
        const int found = features("out.gpkg");
        EXPECT_TRUE(found == all || (found == -1 && status != 0)) << found;
        if (found >= 0)
            expect_sound("out.gpkg");
    }
    EXPECT_GT(killed, times() / 4);
    // Files left behind by killed runs do not disturb the next.
    run_well({"-q", "-overwrite", "dem.tif", "out.gpkg"});
    EXPECT_EQ(features("out.gpkg"), all);
    RecordProperty("killed", killed);
}

TEST_F(Killed, aGeoPackageInUseHoldsTheOldContentOrTheNew) {
    write_text(path("mine.geojson"), R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"note": "my own"}, "geometry": {"type": "Point", "coordinates": [1, 2]}}]})");
    ASSERT_EQ(
        run_tool({"ogr2ogr", "-f", "GPKG", path("out.gpkg"), path("mine.geojson"), "-nln", "mine"}).status,
        0);
    run_well({"-q", "-overwrite", "small.tif", "out.gpkg"});
    const int old = features("out.gpkg");
    const milliseconds whole = duration("out.gpkg");
    const int all = features("out.gpkg");
    ASSERT_GT(all, old);
    int killed = 0;
    for (int i = 0; goes_on(i, killed); ++i) {
        run_well({"-q", "-overwrite", "small.tif", "out.gpkg"});
        {
            const Watcher watcher(path("out.gpkg"));
            const int status = run_killed("out.gpkg", moment(whole));
            killed += status == 128 + SIGKILL ? 1 : 0;
            const int found = features("out.gpkg");
            EXPECT_TRUE(found == all || (found == old && status != 0)) << found << " " << status;
        }
        expect_sound("out.gpkg");
        EXPECT_EQ(sql_value(path("out.gpkg"), "SELECT note FROM mine"), "my own");
    }
    EXPECT_GT(killed, times() / 4);
}

}  // namespace
}  // namespace d2b::test
