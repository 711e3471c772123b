// Blocks of a page, whose places are worked out by hand.
#include "compare/change_page.hpp"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "surveys.hpp"

namespace d2b::test {
namespace {

using namespace compare;

class BlockSink final : public SurfaceSink {
  public:
    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::tiers; }
    void begin(const SurfaceMeta& of_page) override { meta = of_page; }
    void add(const SurfacePart& part) override {
        for (const SurfaceBuilding& building : part.buildings)
            buildings.push_back(building);
    }
    void finish() override {}

    [[nodiscard]] std::string text(std::size_t building, const std::string& field) const {
        for (std::size_t i = 0; i < meta.fields.size(); ++i)
            if (meta.fields[i].name == field)
                return std::get<std::string>(buildings[building].values.at(i));
        return "(no such field)";
    }

    SurfaceMeta meta;
    std::vector<SurfaceBuilding> buildings;
};

/// A house that is raised, one that is gone, and one with a court that is new.
struct ShownChanges {
    ShownChanges() {
        SurveyedBuilding court = box_building(100, 50, 120, 70, 7.5);
        court.outline.front().interiors = {{{105, 55}, {105, 65}, {115, 65}, {115, 55}}};
        const SurveyedPlace before =
            place_of({box_building(10, 20, 20, 30, 6), box_building(50, 20, 60, 30, 5)});
        const SurveyedPlace after = place_of({box_building(10, 20, 20, 30, 9), court});
        const SurveyChanges changes = find_changes(before, after, 1);
        write_change_page(changes, before, after, {Crs("EPSG:25832"), 1, false}, sink);
    }
    BlockSink sink;
};

TEST(ChangePage, hasABlockForEachBuildingOfEachSurvey) {
    const ShownChanges shown;
    ASSERT_EQ(shown.sink.buildings.size(), 4U);
    const std::vector<std::string> expected{"1 old raised", "1 new raised", "2 new new", "3 old gone"};
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(std::to_string(shown.sink.buildings[i].id) + " " + shown.sink.text(i, "survey") + " " +
                      shown.sink.text(i, "change"),
                  expected[i]);
    EXPECT_EQ(shown.sink.buildings[0].roof, 6000);
    EXPECT_EQ(shown.sink.buildings[1].roof, 9000);
    for (const SurfaceBuilding& building : shown.sink.buildings)
        EXPECT_EQ(building.values.size(), shown.sink.meta.fields.size());
    EXPECT_EQ(shown.sink.meta.alternatives, "survey");
    EXPECT_EQ(shown.sink.meta.block_style.classified, "change");
    EXPECT_EQ(shown.sink.meta.block_style.classes.size(), change_names.size());
}

TEST(ChangePage, hasOutlinesInCentimetresAndGroundAround) {
    const ShownChanges shown;
    const SurfaceFrame& frame = shown.sink.meta.frame;
    const SurfaceTier& tier = shown.sink.buildings[2].tiers.at(0);
    ASSERT_EQ(tier.rings.size(), 2U);
    const std::array<double, 3> corner = frame.coordinates(tier.rings[1][2]);
    EXPECT_NEAR(corner[0], 115, 1e-9);
    EXPECT_NEAR(corner[1], 65, 1e-9);
    EXPECT_EQ(tier.top, 7500);
    EXPECT_EQ(frame.scale[0], 0.01);
    // 20 m beyond 10 to 120 m and 20 to 70 m.
    EXPECT_EQ(shown.sink.meta.corners[0], (Position{-10, 90}));
    EXPECT_EQ(shown.sink.meta.corners[2], (Position{140, 0}));
    EXPECT_EQ(frame.local({0, 0, 0}), (std::array<double, 3>{0, 0, 0}));
}

/// A foot is 0.3048 m.
TEST(ChangePage, isInMetresWhateverTheUnit) {
    BlockSink sink;
    const SurveyedPlace place = place_of({box_building(1000, 1000, 1100, 1100, 6)});
    write_change_page(find_changes(place, place, 0.3048), place, place, {Crs("EPSG:2240"), 0.3048, false},
                      sink);
    const std::vector<SurfacePoint>& ring = sink.buildings.at(0).tiers.at(0).rings.at(0);
    const std::array<double, 3> a = sink.meta.frame.local(ring[0]);
    const std::array<double, 3> b = sink.meta.frame.local(ring[1]);
    EXPECT_NEAR(b[0] - a[0], 30.48, 0.01);
}

TEST(ChangePage, showsBuildingsOfUnknownHeightFlat) {
    BlockSink sink;
    const SurveyedPlace place = place_of({box_building(0, 0, 10, 10, RoofHeights::nan)});
    write_change_page(find_changes(place, place, 1), place, place, {{}, 1, false}, sink);
    ASSERT_EQ(sink.buildings.size(), 2U);
    EXPECT_EQ(sink.buildings[0].roof, 100);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(sink.buildings[0].values.back()));
}

TEST(ChangePage, mayHaveNoBuilding) {
    BlockSink sink;
    write_change_page({}, {}, {}, {{}, 1, false}, sink);
    EXPECT_TRUE(sink.buildings.empty());
    EXPECT_EQ(sink.meta.corners[0], (Position{-20, 20}));
}

}  // namespace
}  // namespace d2b::test
