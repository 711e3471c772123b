#include "features/divided_buildings.hpp"

#include <gtest/gtest.h>

#include "support/contour_set.hpp"

namespace d2b::features {
namespace {

contours::Contour footprint(Label label, std::int32_t row, std::int32_t level = 1) {
    contours::Contour contour;
    contour.key = {level, {row, 0}};
    contour.label = label;
    contour.parent = level == 1 ? -1 : 0;
    return contour;
}

/// Heads in memory whose contours of level 1 are buildings.
class FootprintHeads : public contours::ContourList {
  public:
    explicit FootprintHeads(const std::vector<contours::Contour>& contours) {
        std::int64_t building = 0;
        for (const contours::Contour& contour : contours) {
            heads_.push_back({contour.key, contour.label, contour.parent});
            heads_.back().building = contour.key.level == 1 ? building++ : 0;
        }
    }
    [[nodiscard]] std::size_t size() const override { return heads_.size(); }
    [[nodiscard]] const contours::ContourHead& head(std::size_t i) const override { return heads_[i]; }
    [[nodiscard]] contours::Contour fetch(std::size_t /*i*/) const override { return {}; }

  private:
    std::vector<contours::ContourHead> heads_;
};

using PartList = std::vector<PartOfWhole>;
using WholeList = std::vector<std::int64_t>;

TEST(DividedBuildings, PartsAreLabelsWithAFootprint) {
    std::vector<Footprint> of(6);
    const FootprintHeads list({footprint(4, 1), footprint(1, 2), footprint(1, 3), footprint(3, 4),
                               footprint(5, 5), footprint(2, 6, 2)});
    EXPECT_TRUE(parts_of_wholes(list, of).empty());
    of[1].whole = of[2].whole = of[4].whole = 7;
    of[3].whole = -2;
    EXPECT_EQ(parts_of_wholes(list, of), (PartList{{-2, 3}, {7, 1}, {7, 4}}));
}

/// Two footprints of one label are no parts of a building, and neither is one whose other part has none.
TEST(DividedBuildings, WholesHaveSeveralLabels) {
    EXPECT_EQ(divided_wholes({}), WholeList{});
    EXPECT_EQ(divided_wholes({{9, 4}, {3, 2}, {-5, 1}, {3, 1}, {9, 5}, {9, 6}}), (WholeList{3, 9}));
}

}  // namespace
}  // namespace d2b::features
