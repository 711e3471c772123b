#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "outline/arc_graph.hpp"
#include "outline/outline.hpp"
#include "support/outline_checks.hpp"
#include "support/random_grid.hpp"

namespace d2b::outline {
namespace {

using test::one_sided;
using test::planar_area;
using test::TraceGrid;
using test::unit_grid;

/// Turned houses of several labels that touch, with towers, courtyards and ragged edges.
TraceGrid random_town(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    const auto from_to = [&](double low, double high) { return low + (high - low) * below(1000) / 1000.0; };
    const std::int32_t size = 70;
    TraceGrid grid{size, size, std::vector<double>(static_cast<std::size_t>(size) * size, 0.0),
                   std::vector<Label>(static_cast<std::size_t>(size) * size, 0)};
    const double common = from_to(0, 1.5);
    for (Label house = 1; house <= 6; ++house) {
        const double x = from_to(10, 60);
        const double y = from_to(10, 60);
        const double angle = below(3) == 0 ? from_to(0, 1.5) : common;
        const double length = from_to(4, 16);
        const double width = from_to(3, 12);
        const int floors = 1 + below(3);
        const bool yard = below(3) == 0;
        for (std::int32_t row = 0; row < size; ++row)
            for (std::int32_t col = 0; col < size; ++col) {
                const double u = (col - x) * std::cos(angle) + (row - y) * std::sin(angle);
                const double v = (row - y) * std::cos(angle) - (col - x) * std::sin(angle);
                const double ragged = seed % 2 == 0 ? 0 : below(3) * 0.5;
                if (std::abs(u) > length + ragged || std::abs(v) > width + ragged ||
                    (yard && std::abs(u) < length / 3 && std::abs(v) < width / 3))
                    continue;
                const auto at = static_cast<std::size_t>(row * size + col);
                grid.labels[at] = house;
                grid.z[at] = 10 + (u > 0 ? 10 * (floors - 1) : 0) + (v > ragged && floors > 2 ? 10 : 0);
            }
    }
    return grid;
}

struct WallCase {
    TraceGrid grid;
    std::vector<double> thresholds;
    TraceMode mode = TraceMode::cells;
    OutlineRules rules;
    int ground = 1;  // level that stands on no other
};

WallCase wall_case(unsigned seed) {
    WallCase c;
    c.rules.walls = std::array{Walls::automatic, Walls::free, Walls::right, Walls::automatic}[seed % 4];
    c.rules.wall_tolerance = std::array{1.5, 1.0, 2.0}[seed % 3];
    c.rules.wall_inset = std::array{0.4, 0.0, 1.0, 0.0, 0.1, 0.0, 0.0}[seed % 7];
    if (seed % 5 == 0) {
        test::RandomGridCase noise = test::random_grid(seed, 26);
        c.grid = noise.grid;
        c.thresholds = noise.thresholds;
        c.mode = noise.mode;
    } else {
        c.grid = random_town(seed);
        c.thresholds = {5, 15, 25};
        c.mode = seed % 7 == 0 ? TraceMode::points : TraceMode::cells;
    }
    if (seed % 8 < 5) {
        const std::int32_t less = c.mode == TraceMode::points ? 1 : 0;
        c.rules.frame = {{0, 0}, {c.grid.rows - less, c.grid.cols - less}};
    }
    // Without ground around them, houses alone reach the edge.
    if (seed % 8 < 3 && !c.grid.labels.empty()) {
        c.ground = 0;
        for (std::size_t i = 0; i < c.grid.z.size(); ++i)
            if (c.grid.labels[i] == 0)
                c.grid.z[i] = std::numeric_limits<double>::quiet_NaN();
    }
    return c;
}

std::vector<const FineRing*> rings_of(const FinePolygon& polygon) {
    std::vector<const FineRing*> rings{&polygon.exterior};
    for (const FineRing& ring : polygon.interiors)
        rings.push_back(&ring);
    return rings;
}

/// Area that cutting the corners of a staircase may cost beside that: four eighths of a cell.
constexpr double largest_cut_area = 0.5 + 1e-9;

/// Length of a ring that runs along rows and columns, in cells.
double length_of(const FineRing& ring) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint next = ring[(i + 1) % ring.size()];
        sum += std::abs(next.row - ring[i].row) + std::abs(next.col - ring[i].col);
    }
    return static_cast<double>(sum) / FinePoint::steps;
}

double area_of(const FineRing& ring) {
    return planar_area({ring, {}});
}

class RandomWalls : public testing::TestWithParam<unsigned> {
  protected:
    void SetUp() override {
        case_ = wall_case(GetParam());
        set_ = test::trace_grid(case_.grid, case_.thresholds, {case_.mode}, context_);
    }
    [[nodiscard]] Outliner draw() {
        return Outliner(*set_.list, OutlineMethod::regularized, case_.rules, unit_grid, 1, context_);
    }
    Context context_;
    WallCase case_;
    test::ContourSet set_;
};

TEST_P(RandomWalls, AreValidNestedAndDisjoint) {
    const Outliner outliner = draw();
    EXPECT_EQ(test::nesting_fault(set_, outliner), "");
}

TEST_P(RandomWalls, StayNearTheirTraceAndKeepTheirAreas) {
    const Outliner outliner = draw();
    for (std::size_t i = 0; i < set_.contours.size(); ++i) {
        const FinePolygon drawn = outliner.outline(i);
        const FinePolygon traced = fine(contours::traced_polygon(set_.contours[i]));
        const OutlineQuality quality = outliner.quality(i);
        ASSERT_EQ(drawn.interiors.size(), traced.interiors.size());
        EXPECT_LE(quality.deviation_cells, case_.rules.wall_tolerance + 0.5);
        EXPECT_NEAR(quality.area_change, planar_area(drawn) / planar_area(traced) - 1, 1e-9);
        const auto after = rings_of(drawn);
        const auto before = rings_of(traced);
        for (std::size_t r = 0; r < before.size(); ++r) {
            // A fiftieth, or 0.07 of a cell along the border if that is more. Tiers cannot move the walls of
            // lower levels on which they stand.
            const double traced_area = std::abs(area_of(*before[r]));
            const double border = set_.contours[i].key.level > case_.ground ? 0.25 : 0.07;
            const double room =
                std::max(0.02 * traced_area, border * length_of(*before[r])) + largest_cut_area;
            const double inset = case_.rules.wall_inset * length_of(*before[r]);
            const double grown = std::abs(area_of(*after[r])) - traced_area;
            EXPECT_LE(grown, room + (r > 0 ? inset : 0));
            EXPECT_GE(grown, -room - (r > 0 ? 0 : inset));
            EXPECT_LE(one_sided(*after[r], *before[r]), quality.deviation_cells + 1e-9);
            EXPECT_LE(one_sided(*before[r], *after[r]), quality.deviation_cells + 1e-9);
        }
    }
}

TEST_P(RandomWalls, ComeOutTheSameWhereverTheWindowIs) {
    const Outliner outliner = draw();
    test::TraceSettings settings(case_.mode);
    settings.origin = {1234, 56789};
    const test::ContourSet moved = test::trace_grid(case_.grid, case_.thresholds, settings, context_);
    OutlineRules rules = case_.rules;
    if (rules.frame)
        for (LatticePoint* corner : {&rules.frame->low, &rules.frame->high})
            *corner = {corner->row + 1234, corner->col + 56789};
    const Outliner other(*moved.list, OutlineMethod::regularized, rules, unit_grid, 1, context_);
    ASSERT_EQ(moved.contours.size(), set_.contours.size());
    for (std::size_t i = 0; i < moved.contours.size(); ++i) {
        FineRing ring = outliner.outline(i).exterior;
        for (FinePoint& p : ring)
            p = {p.row + 1234 * FinePoint::steps, p.col + 56789 * FinePoint::steps};
        EXPECT_EQ(other.outline(i).exterior, ring);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomWalls, testing::Range(0U, 90U));
/// Nodes that had to go back twice, and whose arcs did not change meanwhile.
INSTANTIATE_TEST_SUITE_P(StubbornSeeds, RandomWalls, testing::Values(1063U, 1123U, 1317U, 2112U, 2967U));

}  // namespace
}  // namespace d2b::outline
