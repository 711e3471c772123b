#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/invalid_elevations.hpp"
#include "core/text.hpp"
#include "options/option_table.hpp"
#include "pipeline/made_town.hpp"

namespace d2b::test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Cell {
    int row;
    int col;
};
constexpr Cell in_flat_roof{26, 28};
constexpr Cell in_street{60, 50};

std::vector<double> surface_with(const std::vector<Cell>& cells, double value, double metres) {
    std::vector<double> z = MadeTown::surface();
    for (double& each : z)
        each /= metres;
    for (const Cell& cell : cells)
        z[MadeTown::index(cell.row, cell.col)] = value;
    return z;
}

/// A town some of whose cells have another value, in its unit.
struct TownWith : MemorySource {
    TownWith(const std::vector<Cell>& cells, double value, double metres = 1)
        : MemorySource(MadeTown::rows, MadeTown::cols, surface_with(cells, value, metres)) {
        edit().name = "town.tif";
        edit().crs_wkt = Crs("EPSG:25833").wkt();
        edit().transform = {500000, 1, 0, 5000000, 0, -1};
    }
};

Options in_unit(const std::string& unit) {
    Options options;
    options.read.vertical_unit = unit;
    return options;
}

void expect_same_features(const Result& one, const Result& other) {
    ASSERT_EQ(one.sink.features.size(), other.sink.features.size());
    for (std::size_t layer = 0; layer < one.sink.features.size(); ++layer) {
        ASSERT_EQ(one.sink.features[layer].size(), other.sink.features[layer].size());
        for (std::size_t i = 0; i < one.sink.features[layer].size(); ++i)
            EXPECT_EQ(one.sink.features[layer][i].values, other.sink.features[layer][i].values);
    }
}

std::vector<double> numbers(const Result& result, const std::string& field) {
    std::vector<double> values;
    for (std::size_t i = 0; i < result.sink.features[buildings].size(); ++i)
        values.push_back(result.sink.number(buildings, i, field));
    return values;
}

class NoElevation : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(All, NoElevation,
                         testing::Values(-9999, -32768, 9999, 65535, -3.4028234663852886e38, 1e300));

TEST_P(NoElevation, IsAsIfItWereDeclared) {
    for (const Preset preset : every_preset) {
        Options options;
        options.preset = preset;
        TownWith declared({in_flat_roof, in_street}, none);
        const Result clean(declared, options);
        EXPECT_EQ(clean.report.warnings, std::vector<std::string>());
        for (const bool ignoring : {false, true}) {
            options.read.ignore_nodata = ignoring;
            TownWith undeclared({in_flat_roof, in_street}, GetParam());
            const Result result(undeclared, options);
            expect_same_features(result, clean);
            const RunReport& report = result.report;
            EXPECT_EQ(report.counted(Reason::elevation_outside_range), 2);
            EXPECT_EQ(report.valid_points, clean.report.valid_points);
            ASSERT_EQ(report.warnings.size(), 1U);
            const std::string value = value_text(GetParam());
            EXPECT_EQ(
                report.warnings[0],
                "2 cells of 'town.tif' have the elevation " + value +
                    ", which is outside the range of land, -500 to 9000 m, and are treated as no data; if " +
                    value + " stands for no data, give -snodata " + value +
                    ", and if not, the range with -zrange.");
        }
    }
}

TEST(SuspiciousValues, TheRangeIsInTheUnitOfTheElevations) {
    const auto counted = [](double value, const std::string& unit, double metres) {
        TownWith town({in_flat_roof}, value, metres);
        const Result result(town, in_unit(unit));
        return result.report.counted(Reason::elevation_outside_range);
    };
    EXPECT_EQ(counted(-1700, "ft", 0.3048), 1);
    EXPECT_EQ(counted(-1600, "ft", 0.3048), 0);
    EXPECT_EQ(counted(-1700, "m", 1), 1);
    EXPECT_EQ(counted(-51000, "0.01", 0.01), 1);
    EXPECT_EQ(counted(-9999, "0.01", 0.01), 0);
}

TEST(SuspiciousValues, AGivenRangeTakesThePlaceOfWhatIsOnLand) {
    Options options;
    options.read.elevation_range = {{0, 120}};
    TownWith town({in_flat_roof}, -1);
    const Result result(town, options);
    EXPECT_EQ(result.report.counted(Reason::elevation_outside_range), 1 + MadeTown::tower.area());
    EXPECT_LE(result.report.maximum, 120);
    ASSERT_GE(result.report.warnings.size(), 1U);
    EXPECT_NE(result.report.warnings[0].find("which is outside of -zrange 0 120, and are treated as no data; "
                                             "give the range of elevations with -zrange."),
              std::string::npos)
        << result.report.warnings[0];
    options.read.elevation_range = {{-20000, 20000}};
    TownWith deep({in_street}, -9999);
    const Result all(deep, options);
    EXPECT_EQ(all.report.minimum, -9999);
}

TEST(SuspiciousValues, WhereMostAreNoElevationsTheRunIsRefused) {
    TownWith town({}, 0, 0.001);  // millimetres
    Result result;
    try {
        run_on(town, {}, result);
        FAIL();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_TRUE(text.starts_with("23800 cells of 'town.tif' have elevations from ")) << text;
        EXPECT_TRUE(text.ends_with(
            ", which is outside the range of land, -500 to 9000 m, and these are more than half of all; give "
            "the unit of the elevations with -zunit, the range in which they lie with -zrange."))
            << text;
    }
    const Result in_millimetres(town, in_unit("0.001"));
    EXPECT_EQ(in_millimetres.report.warnings, std::vector<std::string>());
}

TEST(SuspiciousValues, WhatManyCellsShareFarFromAllOthersIsWarnedOf) {
    std::vector<Cell> cells;
    for (int i = 0; i < 30; ++i)
        cells.push_back({i * 4 + 2, 5});
    for (const Preset preset : every_preset) {
        Options options;
        options.preset = preset;
        TownWith town(cells, 0);
        town.edit().scale = 0.5;
        town.edit().offset = -100;
        const Result result(town, options);
        ASSERT_GE(result.report.warnings.size(), 1U);
        EXPECT_EQ(
            result.report.warnings[0],
            "30 cells of 'town.tif' have the elevation 0, more than 50 m from any other; if 0 stands for no "
            "data, give -snodata 200.");
        EXPECT_EQ(result.report.valid_points, MadeTown::rows * MadeTown::cols);
    }
}

TEST(SuspiciousValues, ADeclaredValueThatComesBackIsSaidSo) {
    TownWith town({in_street}, 99);
    town.edit().overridden_nodata = 99;
    Options options;
    options.read.nodata = -1;
    const Result result(town, options);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(result.report.warnings[0],
              "1 cell of 'town.tif' has the elevation 99, the NoData value that the file declares and "
              "-snodata overrides; if it stands for no data, leave out -snodata.");
}

TEST(SuspiciousValues, ADeclaredValueThatNoLandHasIsNamedAsSuch) {
    for (const bool ignoring : {false, true}) {
        TownWith town({in_street}, -9999);
        town.edit().overridden_nodata = -9999;
        Options options;
        options.read.ignore_nodata = ignoring;
        const Result result(town, options);
        ASSERT_EQ(result.report.warnings.size(), 1U);
        EXPECT_EQ(result.report.warnings[0],
                  std::string("1 cell of 'town.tif' has the elevation -9999, which is outside the range of "
                              "land, -500 to 9000 m, and is treated as no data; it is the NoData value that "
                              "the file declares, so leave out ") +
                      (ignoring ? "-inodata." : "-snodata."));
    }
}

TEST(SuspiciousValues, ASpikeIsNoElevationOrNoRoof) {
    Result clean;
    TownWith town({}, 0);
    run_on(town, {}, clean);
    TownWith holes({in_flat_roof}, none);
    const Result hole(holes, {});
    const double roof = MadeTown::middle(MadeTown::flat) + MadeTown::flat_height;
    TownWith high({in_flat_roof}, roof + 101);
    const Result invalid_above(high, {});
    expect_same_features(invalid_above, hole);
    EXPECT_EQ(invalid_above.report.counted(Reason::elevation_spike), 1);
    ASSERT_EQ(invalid_above.report.warnings.size(), 1U);
    EXPECT_NE(invalid_above.report.warnings[0].find(
                  ", more than 100 m above all cells around, and is treated as no data; if "),
              std::string::npos);

    TownWith mast({in_flat_roof}, roof + 50);
    const Result no_roof(mast, {});
    EXPECT_EQ(no_roof.report.counted(Reason::roof_spike), 1);
    EXPECT_EQ(no_roof.report.valid_points, clean.report.valid_points);
    EXPECT_EQ(no_roof.report.warnings, std::vector<std::string>());
    for (const char* field : {"height", "roof", "p95", "p50"}) {
        const std::vector<double> expected = numbers(clean, field);
        const std::vector<double> got = numbers(no_roof, field);
        ASSERT_EQ(got.size(), expected.size());
        for (std::size_t i = 0; i < got.size(); ++i)
            EXPECT_NEAR(got[i], expected[i], 0.05) << field;
    }
    const std::vector<double> expected = numbers(clean, "volume_m3");
    const std::vector<double> volume = numbers(no_roof, "volume_m3");
    double more = 0;
    for (std::size_t i = 0; i < volume.size(); ++i)
        more += volume[i] - expected[i];
    EXPECT_NEAR(more, 50, 3);  // it is a cell of the building all the same

    Options thesis;
    thesis.preset = Preset::thesis;
    const Result taken(high, thesis);
    EXPECT_EQ(taken.report.counted(Reason::elevation_spike), 0);
    EXPECT_EQ(taken.report.maximum, roof + 101);
}

/// A block of cells in a roof.
std::vector<Cell> patch(int side) {
    std::vector<Cell> cells;
    for (int row = 0; row < side; ++row)
        for (int col = 0; col < side; ++col)
            cells.push_back({24 + row, 24 + col});
    return cells;
}

TEST(SuspiciousValues, HeightsThatCannotBeAreWarnedOfWithTheElevationThatMakesThem) {
    TownWith high(patch(4), 9999, 0.3048);  // 3,048 m is an elevation
    const Result result(high, in_unit("ft"));
    ASSERT_EQ(result.report.warnings.size(), 1U);
    const std::string& text = result.report.warnings[0];
    EXPECT_NE(text.find(" is more than 1000 m high: building "), std::string::npos) << text;
    EXPECT_NE(text.find(" m, has an elevation of 9999; give the value that stands for no data with -snodata, "
                        "the range of "
                        "elevations with -zrange, or their unit with -zunit."),
              std::string::npos)
        << text;
    TownWith low(patch(9), -30, 1);
    const Result deep(low, {});
    for (std::size_t i = 0; i < deep.sink.features[buildings].size(); ++i)
        if (deep.sink.number(buildings, i, "volume_m3") < 0) {
            EXPECT_TRUE(std::ranges::any_of(deep.report.warnings, [](const std::string& said) {
                return said.find("has a negative volume, because it is lower than the ground on average") !=
                           std::string::npos &&
                       said.find(" has an elevation of -30; ") != std::string::npos;
            }));
        }
}

TEST(SuspiciousValues, ThesisBuildingsThatCannotBeAreWarnedOfAsWell) {
    Options options;
    options.preset = Preset::thesis;
    TownWith high(patch(8), 3000);
    const Result result(high, options);
    EXPECT_TRUE(std::ranges::any_of(result.report.warnings, [](const std::string& said) {
        return said.find(" more than 1000 m high: building ") != std::string::npos &&
               said.find(" has an elevation of 3000; give the value that stands for no data with -snodata") !=
                   std::string::npos;
    }));
}

/// The town at 20 m, where an edge of it has a value. @param metres in a vertical unit
struct TownWithCollar : MemorySource {
    explicit TownWithCollar(double value, double metres = 1)
        : MemorySource(MadeTown::rows, MadeTown::cols, elevations(value, metres)) {
        edit().name = "town.tif";
        edit().crs_wkt = Crs("EPSG:25833").wkt();
        edit().transform = {500000, 1, 0, 5000000, 0, -1};
    }
    static constexpr int cells = 20 * MadeTown::cols;  ///< the last rows
    static std::vector<double> elevations(double value, double metres) {
        std::vector<double> z = MadeTown::surface();
        for (double& each : z)
            each = (each - 80) / metres;
        std::fill(z.end() - cells, z.end(), value);
        return z;
    }
};

class Collar : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(All, Collar, testing::Values(0, 255, -1, 1e-3));

TEST_P(Collar, IsAsIfItWereDeclared) {
    for (const Preset preset : every_preset)
        for (const double metres : {1.0, 0.3048}) {
            Options options;
            options.preset = preset;
            options.read.vertical_unit = number_text(metres);
            TownWithCollar declared(none, metres);
            const Result clean(declared, options);
            EXPECT_EQ(clean.report.warnings, std::vector<std::string>());
            TownWithCollar undeclared(GetParam(), metres);
            const Result result(undeclared, options);
            expect_same_features(result, clean);
            EXPECT_EQ(result.report.counted(Reason::elevation_undeclared_nodata), TownWithCollar::cells);
            EXPECT_EQ(result.report.valid_points, clean.report.valid_points);
            const std::string value = value_text(GetParam());
            ASSERT_EQ(result.report.warnings.size(), 1U);
            EXPECT_EQ(result.report.warnings[0], std::to_string(TownWithCollar::cells) +
                                                     " cells of 'town.tif' have the elevation " + value +
                                                     ", lie at its edge, and most cells around are at least "
                                                     "2 m higher or lower, so they are treated "
                                                     "as no data; declare that with -snodata " +
                                                     value + ", or keep the elevation with -inodata.");
        }
}

/// The same, resampled as if the value were an elevation: two more rows are between both.
struct TownWithBlendedCollar : TownWithCollar {
    TownWithBlendedCollar(double value, double beyond) : TownWithCollar(value) {
        for (int i = 1; i <= 2; ++i)
            for (int col = 0; col < MadeTown::cols; ++col) {
                double& z = values()[MadeTown::index(first_row - i, col)];
                z = value + (z - value) * i / 3;
            }
        std::fill(values().end() - cells, values().end(), beyond);
    }
    static constexpr int first_row = MadeTown::rows - 20;
};

/// @param blended cells that are lost: one row more
TEST_P(Collar, ThatWasBlendedIsNoGround) {
    for (const Preset preset : every_preset)
        for (const bool known : {false, true}) {
            Options options;
            options.preset = preset;
            TownWithCollar cut(none);
            std::fill(cut.values().end() - TownWithCollar::cells - 3 * MadeTown::cols, cut.values().end(),
                      none);
            const Result clean(cut, options);
            TownWithBlendedCollar town(GetParam(), known ? none : GetParam());
            if (known)
                town.edit().nodata = GetParam();
            const Result result(town, options);
            expect_same_features(result, clean);
            EXPECT_EQ(result.report.counted(Reason::elevation_blended), 3 * MadeTown::cols);
            EXPECT_EQ(result.report.valid_points, clean.report.valid_points);
            ASSERT_EQ(result.report.warnings.size(), known ? 1U : 2U);
            const std::string value = value_text(GetParam());
            EXPECT_EQ(result.report.warnings.back(),
                      std::to_string(3 * MadeTown::cols) + " cells of 'town.tif' have values blended with " +
                          value +
                          " beside cells without data, as resampling does before that is declared as NoData, "
                          "so they are treated as no data; resample the original raster again, for example "
                          "with gdalwarp -srcnodata " +
                          value + ".");
        }
}

TEST(SuspiciousValues, ACollarStaysWithInodata) {
    Options options;
    options.read.ignore_nodata = true;
    TownWithCollar town(0);
    const Result result(town, options);
    EXPECT_EQ(result.report.counted(Reason::elevation_undeclared_nodata), 0);
    EXPECT_EQ(result.report.minimum, 0);
    EXPECT_EQ(result.report.valid_points, MadeTown::rows * MadeTown::cols);
}

TEST(SuspiciousValues, ANarrowCollarIsNamed) {
    std::vector<Cell> cells;
    for (int row = 0; row < MadeTown::rows; ++row)
        for (int col = 0; col < 3; ++col)
            cells.push_back({row, col});
    TownWith town(cells, 60);  // some 40 m below the ground
    const Result result(town, {});
    ASSERT_GE(result.report.warnings.size(), 1U);
    EXPECT_EQ(result.report.warnings[0],
              "420 cells of 'town.tif' have the elevation 60, lie at its edge, and most cells around are at "
              "least 2 m "
              "higher or lower; if it stands for no data, give -snodata 60, and if not, -inodata.");
    EXPECT_EQ(result.report.valid_points, MadeTown::rows * MadeTown::cols);
}

/// -snodata would make cells of the declared value elevations.
TEST(SuspiciousValues, ASecondNoDataValueIsTurnedIntoTheFirst) {
    const std::string advice =
        "set these cells to the NoData value 255, for example with gdal_calc.py "
        "--calc=\"where(A==0,255,A)\" --NoDataValue=255, ";
    TownWithCollar collar(0);
    collar.edit().nodata = 255;
    const Result taken(collar, {});
    ASSERT_EQ(taken.report.warnings.size(), 1U);
    EXPECT_NE(taken.report.warnings[0].find(advice + "or keep the elevation with -inodata."),
              std::string::npos);
    std::vector<Cell> cells;
    for (int row = 0; row < MadeTown::rows; ++row)
        for (int col = 0; col < 3; ++col)
            cells.push_back({row, col});
    TownWith town(cells, 0);
    town.edit().nodata = 255;
    const Result named(town, {});
    ASSERT_GE(named.report.warnings.size(), 1U);
    EXPECT_NE(named.report.warnings[0].find(advice + "and if not, give -inodata."), std::string::npos);
}

TEST(SuspiciousValues, AHoleFarBelowIsNamedUnlessItIsAPlain) {
    const auto cells = [](int from) {
        std::vector<Cell> hole;
        for (int row = from; row < 60; ++row)
            for (int col = 100; col < 150; ++col)
                hole.push_back({row, col});
        return hole;
    };
    TownWith inside(cells(1), 70);  // some 30 m below the ground
    const Result named(inside, {});
    ASSERT_GE(named.report.warnings.size(), 1U);
    EXPECT_EQ(
        named.report.warnings[0],
        "2950 cells of 'town.tif' have the elevation 70, more than 2 m below any other, and lie inside; "
        "if 70 stands for no data, give -snodata 70, and if not, -inodata.");
    TownWith shallow(cells(1), 98.5);
    EXPECT_EQ(Result(shallow, {}).report.warnings, std::vector<std::string>());
    Options options;
    options.read.ignore_nodata = true;
    EXPECT_EQ(Result(inside, options).report.warnings, std::vector<std::string>());
}

TEST(SuspiciousValues, TheNumberOfThreadsDoesNotMatter) {
    std::vector<Cell> cells;
    for (int i = 0; i < 60; ++i)
        cells.push_back({2 * i + 3, (37 * i) % 165});
    for (const double value : {150.0, 300.0, 9999.0}) {
        TownWith town(cells, value);
        Options options;
        options.run.threads = 1;
        const Result one(town, options);
        for (const int threads : {2, 16}) {
            options.run.threads = threads;
            const Result several(town, options);
            expect_same_features(several, one);
            EXPECT_EQ(several.report.warnings, one.report.warnings);
        }
    }
}

}  // namespace
}  // namespace d2b::test
