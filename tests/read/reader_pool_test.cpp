#include <atomic>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b {
namespace {

using namespace test;

class ReaderPools : public ReadTest, public testing::WithParamInterface<const char*> {};

TEST_P(ReaderPools, GiveEachThreadItsRows) {
    constexpr int cols = 300;
    constexpr int rows = 400;
    constexpr int band = 10;
    RasterSpec spec;
    spec.cols = cols;
    spec.rows = rows;
    spec.type = GDT_Float32;
    spec.values = counting(cols * rows);
    spec.driver = GetParam();
    if (spec.driver == "GTiff")
        spec.creation = {"TILED=YES", "COMPRESS=DEFLATE"};
    write(path("dem"), spec);
    const std::unique_ptr<DemSource> source = open("dem");
    std::atomic<int> wrong = 0;
    Executor(4).for_each(200, [&](std::size_t k) {
        const auto row = static_cast<std::int32_t>(k * 37 % (rows - band));
        std::vector<double> elevations(cols * band);
        source->read(whole_rows(*source, row, band), elevations);
        for (std::size_t i = 0; i < elevations.size(); ++i)
            wrong += elevations[i] == static_cast<double>(row * cols) + static_cast<double>(i) ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_TRUE(warnings_.empty());
}

INSTANTIATE_TEST_SUITE_P(, ReaderPools, testing::Values("GTiff", "ENVI"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace d2b
