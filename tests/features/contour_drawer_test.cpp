#include "features/contour_drawer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "features/drawn_stack.hpp"

namespace d2b::features {
namespace {

using Parts = std::vector<WorldPolygon>;

const WorldPolygon bowtie{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
const WorldPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};

DrawParts gives(const Parts& parts) {
    return [parts] { return parts; };
}
/// Fails as an overlay of GEOS that does not come to its end.
Parts fails() {
    throw GeometryError("GEOS failed on a polygon: TopologyException: side location conflict.");
}

class DrawValid : public ::testing::Test {
  protected:
    ValidParts check(const DrawParts& drawn, const DrawParts& traced) {
        return draw_valid(drawn, traced, geos_, status_, tally_);
    }
    Geos geos_;
    Tally tally_;
    OutlineStatus status_ = OutlineStatus::simplified;
};

TEST_F(DrawValid, anInvalidPolygonIsRepairedAndCounted) {
    status_ = OutlineStatus::traced;
    const ValidParts result = check(gives({bowtie}), gives({}));
    EXPECT_EQ(geos_.invalidity(result.parts), "");
    EXPECT_EQ(status_, OutlineStatus::repaired);
    EXPECT_EQ(result.invalid_reason, "Self-intersection[1 1]");
    EXPECT_EQ(tally_.counted(Reason::polygon_repaired), 1);
    EXPECT_EQ(tally_.counted(Reason::polygon_lost), 0);
}

TEST_F(DrawValid, anInvalidSimplifiedPolygonKeepsItsTracedForm) {
    const ValidParts result = check(gives({bowtie}), gives({square}));
    EXPECT_EQ(result.parts.at(0).exterior, square.exterior);
    EXPECT_EQ(result.invalid_reason, "Self-intersection[1 1]");
    EXPECT_EQ(status_, OutlineStatus::kept_traced);
    EXPECT_EQ(tally_.counted(Reason::outline_kept_traced), 1);
    EXPECT_EQ(tally_.counted(Reason::polygon_repaired), 0);
}

TEST_F(DrawValid, whereTheTracedFormIsInvalidTooItIsRepaired) {
    const WorldPolygon shifted{{{4, 0}, {6, 2}, {6, 0}, {4, 2}}, {}};
    const ValidParts result = check(gives({bowtie}), gives({shifted}));
    EXPECT_EQ(geos_.invalidity(result.parts), "");
    EXPECT_GE(result.parts.at(0).exterior.at(0).x, 4);
    EXPECT_EQ(status_, OutlineStatus::repaired);
    EXPECT_EQ(tally_.counted(Reason::outline_kept_traced), 0);
    EXPECT_EQ(tally_.counted(Reason::polygon_repaired), 1);
}

TEST_F(DrawValid, aValidPolygonIsLeftAlone) {
    const ValidParts result = check(gives({square}), fails);
    EXPECT_EQ(result.parts.at(0).exterior, square.exterior);
    EXPECT_EQ(result.invalid_reason, "");
    EXPECT_EQ(status_, OutlineStatus::simplified);
}

TEST_F(DrawValid, nothingIsAsValid) {
    EXPECT_TRUE(check(gives({}), fails).parts.empty());
    EXPECT_EQ(status_, OutlineStatus::simplified);
}

TEST_F(DrawValid, whereGeosFailsTheTracedFormStands) {
    status_ = OutlineStatus::traced;
    const ValidParts result = check(fails, gives({square}));
    EXPECT_EQ(result.parts.at(0).exterior, square.exterior);
    EXPECT_EQ(result.invalid_reason, "GEOS failed on a polygon: TopologyException: side location conflict.");
    EXPECT_EQ(status_, OutlineStatus::kept_traced);
    EXPECT_EQ(tally_.counted(Reason::outline_kept_traced), 1);
}

TEST_F(DrawValid, whereGeosFailsTwiceThePolygonIsLostAndTheRunGoesOn) {
    EXPECT_TRUE(check(fails, fails).parts.empty());
    EXPECT_EQ(status_, OutlineStatus::repaired);
    EXPECT_EQ(tally_.counted(Reason::polygon_lost), 1);
    EXPECT_EQ(tally_.counted(Reason::outline_kept_traced), 0);
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Whether a ring passes a place on its left, or through it, an odd number of times: exactly, on integers.
bool holds(const FineRing& ring, const FinePoint& p) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint& a = ring[i];
        const FinePoint& b = ring[(i + 1) % ring.size()];
        if ((a.row <= p.row) == (b.row <= p.row))
            continue;
        const std::int64_t to_right = (p.col - a.col) * (b.row - a.row) - (b.col - a.col) * (p.row - a.row);
        if (to_right == 0 || (to_right > 0) == (b.row > a.row))
            inside = !inside;
    }
    return inside;
}

std::vector<std::pair<int, int>> cells_of(const std::vector<RowSpan>& spans) {
    std::vector<std::pair<int, int>> cells;
    for (const RowSpan& span : spans)
        for (std::int32_t col = span.begin; col < span.end; ++col)
            cells.emplace_back(span.row, col);
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

/// A star, so that no two edges cross. @param on corners of the lattice alone
FineRing star(std::mt19937& random, const FinePoint& middle, double least, double most, bool on_corners) {
    std::uniform_real_distribution<double> radius(least, most);
    FineRing ring;
    for (int i = 0; i < 12; ++i) {
        const double angle = i * std::acos(-1.0) / 6;
        const double r = radius(random);
        FinePoint point{middle.row + std::llround(r * std::sin(angle)),
                        middle.col + std::llround(r * std::cos(angle))};
        if (on_corners)
            point = {point.row / 1024 * 1024, point.col / 1024 * 1024};
        ring.push_back(point);
    }
    return ring;
}

TEST(RowSpans, AreTheCellsWhoseMiddlesAPolygonHolds) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 60; ++trial) {
        const bool on_corners = trial % 2 == 0;  // where slanted walls pass through the middles of cells
        const FinePolygon polygon{star(random, {20480, 20480}, 9000, 19000, on_corners),
                                  {star(random, {20480, 20480}, 2000, 6000, on_corners)}};
        std::vector<std::pair<int, int>> expected;
        for (int row = 0; row < 41; ++row)
            for (int col = 0; col < 41; ++col) {
                const FinePoint p{row * 1024 + 512, col * 1024 + 512};
                if (holds(polygon.exterior, p) && !holds(polygon.interiors[0], p))
                    expected.emplace_back(row, col);
            }
        EXPECT_EQ(cells_of(row_spans(polygon)), expected) << trial;
    }
}

TEST(RowSpans, OfPolygonsThatShareAWallShareNoCell) {
    const FinePoint low{0, 0};
    const FinePoint high{4096, 4096};
    const FinePolygon right{{low, high, {0, 4096}}, {}};
    const FinePolygon left{{low, {4096, 0}, high}, {}};
    EXPECT_EQ(row_spans(right), (std::vector<RowSpan>{{0, 0, 4}, {1, 1, 4}, {2, 2, 4}, {3, 3, 4}}));
    EXPECT_EQ(row_spans(left), (std::vector<RowSpan>{{1, 0, 1}, {2, 0, 2}, {3, 0, 3}}));
}

TEST(RowSpans, OfASquareOfCellsAreItsCells) {
    const FinePolygon cells{{{-1024, 2048}, {1024, 2048}, {1024, 5120}, {-1024, 5120}}, {}};
    EXPECT_EQ(row_spans(cells), (std::vector<RowSpan>{{-1, 2, 5}, {0, 2, 5}}));
}

TEST(DrawnStack, IsTheHighestContourInTheBuildings) {
    const FixedPoint fixed(100);
    // A window whose first cell is (100, 50), with a building of 3 x 3 cells and a tier on its middle column
    // that reaches beyond it.
    DrawnStack stack(std::make_unique<MemorySpool>(), {100, 50, 80, 6});
    stack.add_building({{163, 51, 54}, {164, 51, 54}, {165, 51, 54}});
    stack.add_contour({{163, 51, 54}, {164, 51, 54}, {165, 51, 54}}, {10, 10, 1});
    stack.add_contour({{162, 52, 53}, {163, 52, 53}, {164, 52, 53}}, {20, 20, 2});
    stack.add_contour({{163, 40, 90}}, {unknown, unknown, 3});
    const auto error_of = [&](std::int32_t first, std::int32_t rows) {
        ElevationBand band{{first, rows, 6}, std::vector<double>(static_cast<std::size_t>(rows) * 6, 10)};
        if (first <= 164 && 164 < first + rows)
            band.elevations[static_cast<std::size_t>(164 - first) * 6 + 1] = unknown;
        return stack.error(band, fixed);
    };
    StackError whole = error_of(100, 80);
    EXPECT_EQ(whole.n, 8);
    EXPECT_NEAR(whole.rms(fixed), std::sqrt(2 * 100 / 8.0), 1e-9);
    StackError parts = error_of(160, 4);
    EXPECT_EQ(parts.n, 3);
    parts.merge(error_of(100, 60));
    parts.merge(error_of(164, 16));
    EXPECT_EQ(parts.n, whole.n);
    EXPECT_EQ(parts.coarse_squares, whole.coarse_squares);
    EXPECT_EQ(StackError().rms(fixed), 0);
}

/// A tier at the end of a stack is the mean of all that it holds.
TEST(DrawnStack, OfEachLevelIsWhatIsLeftOfIt) {
    const FixedPoint fixed(100);
    DrawnStack stack(std::make_unique<MemorySpool>(), {0, 0, 1, 6});
    stack.add_building({{0, 1, 5}});
    stack.add_contour({{0, 1, 5}}, {10, 13, 1});
    stack.add_contour({{0, 2, 4}}, {unknown, 16, 2});  // its children hold all of it
    stack.add_contour({{0, 2, 3}}, {15, 15, 3});
    stack.add_contour({{0, 3, 4}}, {17, 17, 3});
    const ElevationBand band{{0, 1, 6}, {0, 10, 15, 17, 10, 0}};
    const std::vector<StackError> cuts = stack.errors_by_level(band, fixed, 3);
    ASSERT_EQ(cuts.size(), 3U);
    for (const StackError& cut : cuts)
        EXPECT_EQ(cut.n, 4);
    EXPECT_NEAR(cuts[0].rms(fixed), std::sqrt((9 + 4 + 16 + 9) / 4.0), 1e-9);
    EXPECT_NEAR(cuts[1].rms(fixed), std::sqrt((0 + 1 + 1 + 0) / 4.0), 1e-9);
    EXPECT_EQ(cuts[2].rms(fixed), 0);
    EXPECT_EQ(cuts[2].coarse_squares, stack.error(band, fixed).coarse_squares);
}

TEST(DrawnStack, EndsWithTheWindow) {
    DrawnStack stack(std::make_unique<MemorySpool>(), {0, 0, 2, 2});
    stack.add_building({{-1, 0, 2}, {0, -3, 9}, {1, 2, 5}, {2, 0, 2}});
    stack.add_contour({{0, -3, 1}}, {5, 5, 1});
    const StackError error = stack.error({{0, 2, 2}, {5, 5, 5, 5}}, FixedPoint(5));
    EXPECT_EQ(error.n, 1);
    EXPECT_EQ(error.rms(FixedPoint(5)), 0);
}

}  // namespace
}  // namespace d2b::features
