#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <functional>

#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

using std::chrono::milliseconds;

/// A raster of which nearly all is one object.
struct OneObject {
    const char* name;
    std::function<double(int row, int col)> surface;
    Arguments arguments;
    int side;
};

/// 5 x 5 cells in 8 x 8 of a plateau: square above 59, a comb below 55.
double pits(int row, int col) {
    const int r = row % 8;
    const int c = col % 8;
    if (r >= 5 || c >= 5)
        return 60;
    return r % 2 == 0 || c == 0 ? 53 : 57;
}

/// The same anywhere, whatever was asked before.
double noise(int row, int col) {
    auto mix = static_cast<std::uint32_t>(row) * 73856093U ^ static_cast<std::uint32_t>(col) * 19349663U;
    mix = (mix ^ (mix >> 13)) * 1274126177U;
    return (mix ^ (mix >> 16)) % 1000 / 1000.0;
}

/// A picture's grey: patches of all sizes, one on another.
double ragged(int row, int col) {
    return 10 + 120 * noise(row / 7, col / 7) + 60 * noise(row / 3 + 1000, col / 3) +
           40 * noise(row, col + 5000);
}

/// Arms of a spiral: outlines as long as the raster has cells, which turn one way.
double arms(int row, int col) {
    const double x = col - 600.5;
    const double y = row - 600.5;
    return std::fmod(std::hypot(x, y) / 10 + std::atan2(y, x) / 6.2831853 + 2, 1) < 0.5 ? 20 : 0;
}

class StoppedInOneObject : public CliTest, public ::testing::WithParamInterface<OneObject> {
  protected:
    /// Writes dem.tif: a square that holds the object, with 20 cells of ground on each side.
    void write_object(const std::function<double(int, int)>& surface, int side) const {
        RasterSpec spec = one_block();
        spec.rows = spec.cols = side;
        spec.values.clear();
        for (int row = 0; row < side; ++row)
            for (int col = 0; col < side; ++col) {
                const bool edge = std::min({row, col, side - 1 - row, side - 1 - col}) < 20;
                spec.values.push_back(edge ? 0 : surface(row, col));
            }
        write(path("dem.tif"), spec);
    }
};

TEST_P(StoppedInOneObject, EndsSoonAfterTheSignal) {
    const OneObject& object = GetParam();
    write_object(object.surface, object.side);
    const auto names = entries();
    Arguments arguments = object.arguments;
    arguments.insert(arguments.end(), {"-q", "--", "dem.tif", "out.gpkg"});
    int in_time = 0;
    for (const int after : {150, 300, 900, 1500, 2500}) {
        const auto begin = std::chrono::steady_clock::now();
        const ToolResult result = run(arguments, {.kill = Kill{SIGTERM, milliseconds(after)}});
        const auto took = std::chrono::steady_clock::now() - begin;
        if (result.status == 0)
            break;  // done before that
        ++in_time;
        EXPECT_EQ(result.status, 143) << result.err;
        EXPECT_EQ(entries(), names);
        // Sanitizers and busy machines are slow; a run that did not ask went on for a minute.
        EXPECT_LT(took, milliseconds(after + (D2B_SANITIZED != 0 ? 20000 : 8000)));
    }
    EXPECT_GE(in_time, 1);
}

const Arguments thesis{"-preset", "thesis", "-trace", "cells", "-fl", "55", "59", "-nf", "30"};

Arguments with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

INSTANTIATE_TEST_SUITE_P(
    All, StoppedInOneObject,
    ::testing::Values(
        OneObject{"holes", pits, with(thesis, {"-regularize", "off"}), 2600},
        OneObject{"holesWithWalls", pits, with(thesis, {"-regularize", "auto"}), 1200},
        OneObject{"holesInBands", pits, with(thesis, {"-regularize", "off", "-disjoint"}), 1200},
        OneObject{"ragged", ragged, {}, 1200},
        OneObject{"raggedInAnotherCrs", ragged, {"-t_srs", "EPSG:4326"}, 1200},
        OneObject{"spiralStraightened",
                  arms,
                  {"-preset", "thesis", "-trace", "cells", "-fl", "5", "-nf", "0", "-simplify", "2"},
                  1200}),
    [](const ::testing::TestParamInfo<OneObject>& object) { return std::string(object.param.name); });

#ifdef __OPTIMIZE__
constexpr double slower = D2B_SANITIZED != 0 ? 20 : 1;
#else
constexpr double slower = D2B_SANITIZED != 0 ? 40 : 10;
#endif

/// Outlines that narrow places are taken from: a block of 63,504 cells.
class StoppedInARaggedBlock : public StoppedInOneObject {
  protected:
    void SetUp() override {
        StoppedInOneObject::SetUp();
        preset_ = "";
    }
};

TEST_P(StoppedInARaggedBlock, EndsWithinASecondOfProcessor) {
    const OneObject& object = GetParam();
    write_object(object.surface, object.side);
    Arguments arguments =
        with(object.arguments, {"-threads", "1", "-ground", "none", "-min_confidence", "0", "-levels",
                                "building", "-overwrite", "-q", "--", "dem.tif", "out.gpkg"});
    const ToolResult whole = run(arguments);
    ASSERT_EQ(whole.status, 0) << whole.err;
    EXPECT_LT(whole.cpu_seconds, 5 * slower);
    std::filesystem::remove(path("out.gpkg"));
    const auto names = entries();
    int in_time = 0;
    for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8, 0.9}) {
        const ToolResult result =
            run(arguments, {.kill = Kill{SIGTERM, milliseconds(0), share * whole.cpu_seconds}});
        if (result.status == 0)
            break;  // done before that
        ++in_time;
        EXPECT_EQ(result.status, 143) << result.err;
        EXPECT_EQ(entries(), names);
        // A run that did not ask would go on to its end.
        const double after = result.cpu_seconds - result.cpu_seconds_at_signal;
        EXPECT_LT(after, slower) << share;
        if (share < 0.6) {
            EXPECT_LT(after, whole.cpu_seconds * (1 - share) / 2) << share;
        }
    }
    EXPECT_GE(in_time, 3);
}

INSTANTIATE_TEST_SUITE_P(All, StoppedInARaggedBlock,
                         ::testing::Values(OneObject{"flow_ready", ragged, {"-flow_ready", "2"}, 292},
                                           OneObject{"min_gap", ragged, {"-min_gap", "2"}, 292},
                                           OneObject{"min_wall", ragged, {"-min_wall", "2"}, 292}),
                         [](const ::testing::TestParamInfo<OneObject>& object) {
                             return std::string(object.param.name);
                         });

}  // namespace
}  // namespace d2b::test
