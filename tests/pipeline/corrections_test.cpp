#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/correction_source.hpp"
#include "pipeline/block_town.hpp"
#include "pipeline/run.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b::test {
namespace {

class MadeCorrections final : public CorrectionSource {
  public:
    explicit MadeCorrections(std::vector<Correction> all) { replace(std::move(all)); }
    void replace(std::vector<Correction> all) {
        all_ = std::move(all);
        for (std::size_t i = 0; i < all_.size(); ++i)
            all_[i].name = "feature " + std::to_string(i + 1);
    }
    [[nodiscard]] const std::vector<Correction>& corrections() const override { return all_; }

  private:
    std::vector<Correction> all_;
};

Correction area(CorrectionKind kind, const Box& box) {
    Correction correction{kind, false, {}, {}, {}};
    for (int row = box.row; row < box.row + box.rows; ++row)
        correction.cells.push_back({row, box.col, box.col + box.cols});
    return correction;
}

Correction point(CorrectionKind kind, int row, int col) {
    return {kind, true, {{row, col, col + 1}}, {}, {}};
}

Correction cut_below(int row, int first_col, int end_col) {
    Correction correction{CorrectionKind::cut, false, {}, {}, {}};
    for (int col = first_col; col < end_col; ++col)
        correction.cuts.push_back({row, col, true});
    return correction;
}

/// Blocks over the seams of units of 100 x 100 cells, and one inside a unit.
constexpr Box west_house{90, 30, 20, 60};
constexpr Box middle{140, 80, 24, 50};
constexpr Box south_house{190, 140, 24, 70};
constexpr Box inner{30, 40, 14, 20};
constexpr Box heap{205, 30, 14, 14};

BlockTown blocks() {
    BlockTown town(300, 300);
    for (const Box& box : {west_house, middle, south_house, inner})
        town.build(box, 7);
    // Rough as a crown.
    for (int r = heap.row; r < heap.row + heap.rows; ++r)
        for (int c = heap.col; c < heap.col + heap.cols; ++c)
            town.z[town.index(r, c)] += 3 + (r * 7 + c * 5) % 4 * 2.5;
    return town;
}

std::vector<Correction> decisions() {
    return {point(CorrectionKind::no_building, 99, 35),             // west, next to the seam
            area(CorrectionKind::building, heap),                   //
            cut_below(151, 0, 300),                                 // middle
            area(CorrectionKind::no_building, {190, 140, 24, 36}),  // south, more than half
            point(CorrectionKind::building, 250, 250),              // nothing
            cut_below(36, 40, 50),                                  // inner, but not through
            {CorrectionKind::building, true, {}, {}, {}}};          // outside
}

Options detection_options() {
    Options options;
    options.ground.max_building_width = 30;
    options.detect.corrections = "edits";
    return options;
}

struct Editing {
    explicit Editing(std::vector<Correction> all = decisions()) : corrections(std::move(all)) {
        place_in_utm(dem, 1);
        place_in_utm(exclusion, 1);
    }
    [[nodiscard]] Sources sources() {
        return {dem,         nullptr, nullptr, nullptr, nullptr, nullptr, excludes ? &exclusion : nullptr,
                &corrections};
    }
    void run(const Options& options, const detect::UnitSize& units = {}) {
        result.report = pipeline::run_in_units(options, sources(), {result.sink}, {}, units);
    }

    Result result;
    MemorySource dem = blocks().source();
    MemorySource exclusion = blocks().on_grid([](int row, int col) {
        return Box{85, 25, 30, 70}.holds(row, col) ? 1.0 : 0.0;
    });
    MadeCorrections corrections;
    bool excludes = false;
};

double area_in(const Result& result, const Box& box) {
    double sum = 0;
    for (const Feature& feature : result.sink.features.at(buildings)) {
        const Position& corner = feature.parts.front().exterior.front();
        const double col = corner.x - 600000;
        const double row = 5800000 - corner.y;
        if (col > box.col - 2 && col < box.col + box.cols + 2 && row > box.row - 2 &&
            row < box.row + box.rows + 2)
            sum += std::get<BuildingRecord>(feature.record).area_m2;
    }
    return sum;
}

TEST(Decisions, ChangeTheResult) {
    Editing editing;
    editing.run(detection_options());
    const Result& result = editing.result;
    EXPECT_EQ(area_in(result, west_house), 0);
    EXPECT_EQ(area_in(result, south_house), 0);
    EXPECT_NEAR(area_in(result, middle), middle.area(), 30);
    EXPECT_NEAR(area_in(result, inner), inner.area(), 8);
    EXPECT_GT(area_in(result, heap), 0.8 * heap.area());
    EXPECT_EQ(result.report.buildings, 4);  // both parts of the middle one
    EXPECT_EQ(result.report.counted(Reason::building_denied), 2);
    ASSERT_TRUE(result.report.corrections);
    const CorrectionReport& report = *result.report.corrections;
    EXPECT_EQ(report.building, 3);
    EXPECT_EQ(report.no_building, 2);
    EXPECT_EQ(report.cut, 2);
    EXPECT_EQ(report.without_effect, 2);
    EXPECT_EQ(report.outside, 1);
    EXPECT_EQ(
        result.report.warnings,
        (std::vector<std::string>{
            "2 corrections of 'edits' had no effect: feature 5 ('building'), feature 6 ('cut'); nothing "
            "is there that could be changed, or a cut does not go through or cuts off too little.",
            "1 correction of 'edits' lies outside of the raster, or between the centres of its cells: "
            "feature 7 ('building')."}));
}

/// Units, tiles and threads make no difference.
TEST(Decisions, AreTheSameInTilesAsInOneRun) {
    for (const bool excludes : {false, true}) {
        Editing editing;
        editing.excludes = excludes;
        if (excludes)
            editing.corrections.replace({cut_below(151, 0, 300)});
        const Options options = detection_options();
        const detect::UnitSize units{0, 100};
        editing.run(options, units);
        const Result& whole = editing.result;
        EXPECT_EQ(whole.report.counted(Reason::building_excluded), excludes ? 1 : 0);
        EXPECT_EQ(whole.report.counted(Reason::building_denied), excludes ? 0 : 2);
        EXPECT_EQ(area_in(whole, west_house), 0);
        for (const std::int32_t side : {1, 2}) {
            TemporaryFolder folder;
            Result tiles;
            StepsInTiles(editing.sources(), options, {folder.path(), 7, side, units})
                .run({side, side == 2, false, 2}, tiles);
            expect_same(tiles, whole);
            ASSERT_TRUE(tiles.report.corrections);
            EXPECT_EQ(tiles.report.corrections->without_effect, whole.report.corrections->without_effect);
            EXPECT_EQ(tiles.report.dropped, whole.report.dropped);
            EXPECT_EQ(tiles.report.warnings, whole.report.warnings);
        }
    }
}

/// Buildings that an editor has confirmed are not excluded.
TEST(Decisions, BeatExclusions) {
    Editing editing(std::vector{area(CorrectionKind::building, west_house)});
    editing.excludes = true;
    editing.run(detection_options());
    const Result& result = editing.result;
    EXPECT_NEAR(area_in(result, west_house), west_house.area(), 15);
    EXPECT_EQ(result.report.counted(Reason::building_excluded), 0);
}

TEST(Exclusions, LeaveOutObjectsOfWhichHalfLiesInThem) {
    Editing editing(std::vector<Correction>{});
    editing.excludes = true;
    editing.run(detection_options());
    const Result& result = editing.result;
    EXPECT_EQ(area_in(result, west_house), 0);
    for (const Box& other : {middle, south_house, inner, heap})
        EXPECT_GT(area_in(result, other), 0.5 * other.area()) << other.row;
    EXPECT_EQ(result.report.buildings, 4);
    EXPECT_EQ(result.report.counted(Reason::building_excluded), 1);
    EXPECT_TRUE(result.report.warnings.empty());
}

}  // namespace
}  // namespace d2b::test
