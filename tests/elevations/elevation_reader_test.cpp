#include "elevations/elevation_reader.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

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

/// All elevations of a reader's bands.
std::vector<double> all_of(ElevationReader& reader) {
    std::vector<double> all;
    reader.for_each([&](const ElevationBand& band) {
        all.insert(all.end(), band.elevations.begin(), band.elevations.end());
    });
    return all;
}

TEST(ElevationReader, KeepsWhatItReadToTheLastBit) {
    for (const double step : {0.25, 0.1}) {  // the second is no float
        std::vector<double> z;
        for (int i = 0; i < 600; ++i)
            z.push_back(100 + step * i);
        MemorySource source(20, 30, z);
        Context context;
        ElevationReader reader(source, context);
        EXPECT_EQ(all_of(reader), z);
        EXPECT_EQ(all_of(reader), z);
        EXPECT_EQ(source.reads, 1);
    }
}

TEST(ElevationReader, ReadsAgainWhatItHasNoRoomFor) {
    const auto reads = [](double z, std::size_t room) {
        MemorySource source(20, 30, std::vector<double>(600, z));
        Context context;
        ElevationReader reader(source, context, {.keep_bytes = room});
        EXPECT_EQ(all_of(reader), all_of(reader));
        EXPECT_EQ(all_of(reader), std::vector<double>(600, z));
        return source.reads;
    };
    EXPECT_EQ(reads(0.5, 2400), 1);
    EXPECT_EQ(reads(0.5, 2399), 3);
    EXPECT_EQ(reads(0.1, 4800), 1);
    EXPECT_EQ(reads(0.1, 4799), 3);  // found out on the way
}

TEST(ElevationReader, GivesEachBandTheRowsAboveIt) {
    constexpr std::int32_t cols = 5;
    std::vector<double> z;
    for (int i = 0; i < 300 * cols; ++i)
        z.push_back(0.1 * i);
    for (const std::size_t room : {std::size_t{0}, std::size_t{1} << 20})
        for (const std::int32_t first : {0, 62, 63, 64})  // the first band: 64, 2, 1 and 64 rows
            for (const int threads : {1, 4}) {
                MemorySource source(300, cols, z);
                source.edit().window = {first, 0, 300 - first, cols};
                Context context;
                context.threads = std::make_unique<Executor>(threads);
                ElevationReader reader(source, context, {0, room});
                for (int pass = 0; pass < 2; ++pass)
                    reader.for_each_with_halo(
                        2,
                        [&](ElevationBand above, const ElevationBand& band, Tally&) {
                            EXPECT_EQ(above.shape.first_row + above.shape.rows, band.shape.first_row);
                            return above;
                        },
                        [&](const ElevationBand& band, const ElevationBand& above) {
                            const std::int32_t rows = std::min(2, band.shape.first_row - first);
                            const auto end = z.begin() + std::ptrdiff_t{band.shape.first_row} * cols;
                            EXPECT_EQ(above.shape.rows, rows);
                            EXPECT_EQ(above.elevations,
                                      std::vector<double>(end - std::ptrdiff_t{rows} * cols, end));
                        });
            }
}

/// Ground of 10 with spikes of some heights beside every seam, values that are no elevations, and holes.
std::vector<double> spiky(std::int32_t rows, std::int32_t cols, std::int32_t rows_a_band) {
    std::vector<double> z(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols), 10);
    const auto at = [&](std::int32_t row, std::int32_t col) -> double& {
        return z[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                 static_cast<std::size_t>(col)];
    };
    for (std::int32_t seam = rows_a_band; seam < rows; seam += rows_a_band) {
        at(seam, 3) = 200;
        at(seam - 1, 7) = 200;
        at(seam, 11) = 60;
        at(seam - 1, 15) = 60;
        at(seam, 19) = at(seam - 1, 20) = 200;  // neighbours
        at(seam, 24) = at(seam - 1, 24) = -9999;
    }
    at(0, 0) = at(rows - 1, cols - 1) = 150;
    return z;
}

TEST(ElevationReader, DecidesWhatIsAnElevationAcrossBandsAndForEveryPass) {
    constexpr std::int32_t cols = 30;
    constexpr std::int32_t rows_a_band = 64;
    const std::vector<double> z = spiky(1000, cols, rows_a_band);
    for (const std::size_t room : {std::size_t{1} << 30, std::size_t{0}})
        for (const int threads : {1, 2, 16}) {
            MemorySource source(1000, cols, z);
            Context context;
            context.threads = std::make_unique<Executor>(threads);
            ElevationReader reader(source, context, {.points = 1, .keep_bytes = room});
            ASSERT_EQ(reader.bands(), 16U);
            const ValidityRules rules{land_elevations, spikes_m, 1, {}};
            const ElevationSurvey survey = reader.survey(rules, [](const ElevationBand&) {});
            EXPECT_EQ(survey.suspicious.outside.cells(), 15 * 2);
            EXPECT_EQ(survey.suspicious.spikes.cells(), 15 * 2 + 2);
            EXPECT_EQ(survey.suspicious.spires, 15 * 2);
            EXPECT_EQ(survey.statistics.moments.n, 30000 - 15 * 4 - 2);
            EXPECT_EQ(survey.statistics.maximum, 200);  // two side by side
            EXPECT_EQ(survey.statistics.minimum, 10);
            for (int pass = 0; pass < 2; ++pass) {
                std::int64_t invalid = 0;
                std::size_t spires = 0;
                reader.for_each([&](const ElevationBand& band) {
                    invalid += std::ranges::count_if(band.elevations, [](double e) { return std::isnan(e); });
                    spires += band.spires.size();
                    for (const std::size_t spire : band.spires)
                        EXPECT_EQ(band.elevations[spire], 60);
                });
                EXPECT_EQ(invalid, 15 * 4 + 2);
                EXPECT_EQ(spires, 30U);
            }
        }
}

TEST(ElevationReader, GivesAnyPartOfTheWindow) {
    constexpr std::int32_t cols = 30;
    constexpr std::int32_t rows_a_band = 64;
    // Elevations that floats hold, and that they do not.
    for (const double off : {0.0, 0.1})
        for (const std::size_t room : {std::size_t{1} << 30, std::size_t{0}}) {
            std::vector<double> z = spiky(1000, cols, rows_a_band);
            for (std::size_t i = 0; i < z.size(); ++i)
                z[i] += z[i] == 10 ? static_cast<double>(i % 7) + off : 0;
            MemorySource source(1000, cols, z);
            source.edit().window = {30, 4, 900, 25};
            Context context;
            context.threads = std::make_unique<Executor>(3);
            ElevationReader reader(source, context, {.points = 1, .keep_bytes = room});
            (void)reader.survey({land_elevations, spikes_m, 1, {}}, [](const ElevationBand&) {});
            std::vector<double> whole;
            std::vector<std::size_t> spires;
            reader.for_each([&](const ElevationBand& band) {
                for (const std::size_t spire : band.spires)
                    spires.push_back(whole.size() + spire);
                whole.insert(whole.end(), band.elevations.begin(), band.elevations.end());
            });
            ASSERT_GT(spires.size(), 20U);
            for (const Window& part : {Window{30, 4, 900, 25}, Window{100, 9, 300, 11}, Window{127, 28, 2, 1},
                                       Window{640, 4, 1, 25}, Window{650, 8, 280, 4}}) {
                std::vector<int> seen(static_cast<std::size_t>(part.points()), 0);
                std::atomic<std::size_t> spires_seen = 0;
                reader.for_part(part, [&](const ElevationBand& piece) {
                    ASSERT_EQ(piece.shape.cols, part.cols);
                    for (std::int32_t r = 0; r < piece.shape.rows; ++r)
                        for (std::int32_t c = 0; c < part.cols; ++c) {
                            const std::int32_t row = piece.shape.first_row + r;
                            ++seen[static_cast<std::size_t>((row - part.row) * part.cols + c)];
                            const double expected =
                                whole[static_cast<std::size_t>((row - 30) * 25 + part.col + c - 4)];
                            const double got = piece.row(r)[static_cast<std::size_t>(c)];
                            EXPECT_TRUE(got == expected || (std::isnan(got) && std::isnan(expected)));
                        }
                    spires_seen += piece.spires.size();
                    for (const std::size_t spire : piece.spires)
                        EXPECT_EQ(piece.elevations[spire], 60);
                });
                EXPECT_EQ(std::ranges::count(seen, 1), part.points());
                EXPECT_EQ(static_cast<std::ptrdiff_t>(spires_seen.load()),
                          std::ranges::count_if(spires, [&](std::size_t i) {
                              const auto row = static_cast<std::int32_t>(i / 25) + 30;
                              const auto col = static_cast<std::int32_t>(i % 25) + 4;
                              return row >= part.row && row < part.end_row() && col >= part.col &&
                                     col < part.end_col();
                          }));
            }
        }
}

/// Checks that a lent window holds the values of bands, where floats hold them.
void expect_lent(ElevationReader& reader, const Window& window) {
    const std::vector<double> expected = all_of(reader);
    MetreGrid lent = reader.lend(window);
    ASSERT_EQ(lent.rows, window.rows);
    ASSERT_EQ(lent.cols, window.cols);
    for (std::size_t i = 0; i < lent.size(); ++i)
        ASSERT_TRUE(static_cast<double>(lent.values[i]) == expected[i] ||
                    (std::isnan(lent.values[i]) && std::isnan(expected[i])))
            << i;
    reader.take_back(std::move(lent));
    const std::vector<double> after = all_of(reader);
    for (std::size_t i = 0; i < after.size(); ++i)
        ASSERT_TRUE(after[i] == expected[i] || (std::isnan(after[i]) && std::isnan(expected[i]))) << i;
}

TEST(ElevationReader, LendsAllThatItKeepsAsFloats) {
    const Window window{30, 4, 900, 25};
    for (const double off : {0.0, 0.1})  // the second is no float
        for (const std::size_t room : {std::size_t{1} << 30, std::size_t{0}}) {
            std::vector<double> z = spiky(1000, 30, 64);
            z[500 * 30 + 9] += off;
            MemorySource source(1000, 30, z);
            source.edit().window = window;
            Context context;
            context.threads = std::make_unique<Executor>(3);
            ElevationReader reader(source, context, {.points = 1, .keep_bytes = room});
            EXPECT_EQ(reader.lend(window).size(), 0U) << "nothing is kept yet";
            (void)reader.survey({land_elevations, spikes_m, 1, {}}, [](const ElevationBand&) {});
            EXPECT_EQ(reader.lend({30, 4, 899, 25}).size(), 0U);
            if (off == 0 && room > 0)
                expect_lent(reader, window);
            else
                EXPECT_EQ(reader.lend(window).size(), 0U);
        }
}

TEST(ElevationReader, ReadsNoMoreThanThePart) {
    MemorySource source(40000, 30, std::vector<double>(1200000, 1));
    Context context;
    ElevationReader reader(source, context);
    ASSERT_GT(reader.bands(), 2U);
    reader.for_part({17000, 3, 500, 20}, [&](const ElevationBand& piece) {
        EXPECT_GE(piece.shape.first_row, 17000);
        EXPECT_LE(piece.shape.first_row + piece.shape.rows, 17500);
        EXPECT_EQ(piece.shape.cols, 20);
    });
    EXPECT_EQ(source.reads, 1);
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
        void read(const Window& part, std::span<double>) override { read_to = part.end_row(); }
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
