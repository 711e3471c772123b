#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "features/contour_drawer.hpp"

namespace d2b {
namespace {

using Parts = std::vector<WorldPolygon>;

const WorldPolygon bowtie{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
const WorldPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};

DrawParts gives(const Parts& parts) {
    return [parts] { return parts; };
}
/// As an overlay of GEOS that does not come to its end.
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

}  // namespace
}  // namespace d2b
