#include "pipeline/elevation_reader.hpp"

#include <gtest/gtest.h>

#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

using test::block;
using test::MemorySource;

TEST(ElevationReader, ReadsAgainAfterAFailure) {
    MemorySource source = block();
    Context context;
    ElevationReader reader(source, context);
    EXPECT_THROW(reader.for_each([](const ElevationBand&) { throw Cancelled(); }), Cancelled);
    std::int32_t rows = 0;
    for (int pass = 0; pass < 2; ++pass)
        reader.for_each([&](const ElevationBand& band) { rows += band.shape.rows; });
    EXPECT_EQ(rows, 2 * 10);
    EXPECT_EQ(source.reads, 2);
}

TEST(ElevationReader, BandsReachTheLastRowOfTheLargestRaster) {
    class TallSource : public DemSource {
      public:
        TallSource() {
            info_.rows = 2147483647;
            info_.cols = 1;
            info_.window = {2147483500, 0, 147, 1};
        }
        [[nodiscard]] const DemInfo& info() const override { return info_; }
        void read(std::int32_t first, std::int32_t rows, std::span<double>) override {
            read_to = first + rows;
        }
        std::int32_t read_to = 0;

      private:
        DemInfo info_;
    };
    TallSource source;
    Context context;
    ElevationReader(source, context).for_each([](const ElevationBand&) {});
    EXPECT_EQ(source.read_to, 2147483647);
}

}  // namespace
}  // namespace d2b
