#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

using test::block;
using test::buildings;
using test::cells;
using test::MemorySource;
using test::place_in_utm;
using test::Result;
using test::run_on;

TEST(Pipeline, ALargeToleranceIsWarnedOf) {
    MemorySource source = block();
    source.edit().transform = {13, 1e-5, 0, 52, 0, -1e-5};
    source.edit().crs_wkt = Crs("EPSG:4326").wkt();
    Options options = cells({10});
    options.outline.simplify = 1;
    Result result;
    run_on(source, options, result);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(
        result.report.warnings[0],
        "-simplify 1 is 100000 cells wide, which leaves little of a building; it is in units of the input's "
        "CRS.");
}

TEST(Pipeline, WhatGeosRefusesIsWarnedOfByItsId) {
    MemorySource source = block();
    source.edit().transform = {600000, 1e-13, 0, 5800000, 0, -1e-13};  // all positions are one double
    source.edit().crs_wkt = "";
    Result result;
    run_on(source, cells({10}), result);
    const std::vector<std::string>& warnings = result.report.warnings;
    for (const char* feature : {"Building 1 ", "Contour 2 "}) {
        const auto is_of = [&](const std::string& text) {
            return text.starts_with(feature + std::string("would not have been a valid polygon (")) &&
                   text.ends_with("); it is not written.");
        };
        EXPECT_EQ(std::ranges::count_if(warnings, is_of), 1) << feature << warnings.front();
    }
    EXPECT_EQ(result.report.buildings, 0);
    EXPECT_GE(result.report.counted(Reason::polygon_lost), 2);
}

TEST(Pipeline, CoarseCellsAreWarnedOf) {
    MemorySource source = block();
    place_in_utm(source, 5);
    Result result;
    run_on(source, cells({10}), result);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(result.report.warnings[0],
              "The cells are 5.0 m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m "
              "may do.");
}

std::string only_warning(MemorySource& source, const Options& options) {
    Result result;
    run_on(source, options, result);
    EXPECT_TRUE(result.sink.finished);
    EXPECT_EQ(result.sink.features[buildings].size(), 0U);
    EXPECT_EQ(result.report.warnings.size(), 1U);
    return result.report.warnings.empty() ? "" : result.report.warnings[0];
}

TEST(Pipeline, NothingToFindIsAWarning) {
    Options thesis;
    thesis.preset = Preset::thesis;
    MemorySource nothing(2, 2, std::vector<double>(4, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(only_warning(nothing, thesis), "'memory' has no valid point; the layers are empty.");
    MemorySource flat(3, 3, std::vector<double>(9, 7.0));
    EXPECT_EQ(only_warning(flat, thesis),
              "All valid points of 'memory' have the same elevation; no building was found.");
    MemorySource low = block();
    EXPECT_EQ(only_warning(low, cells({100})),
              "No threshold lies between the lowest and the highest elevation; no building was found.");
    MemorySource line(1, 5, {0, 9, 9, 9, 0});
    EXPECT_EQ(only_warning(line, thesis),
              "No building was found; a smaller -nf or -min_area, or more levels, may show some.");
}

}  // namespace
}  // namespace d2b
