#include "pipeline/checked.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

const WorldPolygon bowtie{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
const WorldPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};

TEST(Checked, AnInvalidPolygonIsRepairedAndCounted) {
    Geos geos;
    RunReport report;
    OutlineStatus status = OutlineStatus::traced;
    const auto parts = checked(
        {bowtie}, [] { return std::vector<WorldPolygon>{}; }, geos, status, report);
    EXPECT_EQ(geos.invalidity(parts), "");
    EXPECT_EQ(status, OutlineStatus::repaired);
    EXPECT_EQ(report.counted(Reason::polygon_repaired), 1);
}

TEST(Checked, AnInvalidSimplifiedPolygonKeepsItsTracedForm) {
    Geos geos;
    RunReport report;
    OutlineStatus status = OutlineStatus::simplified;
    const auto parts = checked(
        {bowtie}, [] { return std::vector<WorldPolygon>{square}; }, geos, status, report);
    EXPECT_EQ(parts[0].exterior, square.exterior);
    EXPECT_EQ(status, OutlineStatus::kept_traced);
    EXPECT_EQ(report.counted(Reason::outline_kept_traced), 1);
    EXPECT_EQ(report.counted(Reason::polygon_repaired), 0);
}

TEST(Checked, AValidPolygonIsLeftAlone) {
    Geos geos;
    RunReport report;
    OutlineStatus status = OutlineStatus::simplified;
    const auto parts = checked(
        {square}, [] { return std::vector<WorldPolygon>{}; }, geos, status, report);
    EXPECT_EQ(parts[0].exterior, square.exterior);
    EXPECT_EQ(status, OutlineStatus::simplified);
}

}  // namespace
}  // namespace d2b
