#define GEOS_USE_ONLY_R_API
#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "geometry/geos_converter.hpp"
#include "geometry/validity.hpp"
#include "support/box.hpp"

namespace d2b {
namespace {

using test::box;

WorldRing hole(double x0, double y0, double x1, double y1) {
    WorldRing ring = box(x0, y0, x1, y1).exterior;
    return {ring.rbegin(), ring.rend()};
}

/// A comb of 1,000 teeth on a back that has 60 x 60 holes of 3 x 3 in it.
WorldPolygon comb() {
    WorldPolygon polygon;
    constexpr int teeth = 1000;
    polygon.exterior = {{0, 0}, {2 * teeth, 0}};
    for (int tooth = teeth; tooth-- > 0;)
        for (const Position p : {Position{2.0 * tooth + 2, 300}, Position{2.0 * tooth + 1, 300},
                                 Position{2.0 * tooth + 1, 250}, Position{2.0 * tooth, 250}})
            if (tooth > 0 || p.y > 250)
                polygon.exterior.push_back(p);
    polygon.exterior.push_back({0, 250});
    for (int row = 0; row < 60; ++row)
        for (int col = 0; col < 60; ++col)
            polygon.interiors.push_back(hole(4.0 * col + 1, 4.0 * row + 1, 4.0 * col + 4, 4.0 * row + 4));
    return polygon;
}

bool geos_says_valid(const std::vector<WorldPolygon>& polygons) {
    const GeosConverter geos;
    return geos.predicate(GEOSisValid_r(geos.context(), geos.multi_polygon(polygons).get()));
}

struct Change {
    const char* name;
    const char* reason;  ///< beginning of the message about it
    std::function<void(WorldPolygon&)> make;
};

class VastPolygon : public testing::TestWithParam<Change> {};

TEST_P(VastPolygon, IsJudgedAsGeosWould) {
    WorldPolygon polygon = comb();
    GetParam().make(polygon);
    ASSERT_TRUE(needs_inside_out_check(polygon));
    const std::string reason = Geos().invalidity({polygon});
    EXPECT_EQ(reason.empty(), geos_says_valid({polygon})) << reason;
    EXPECT_EQ(reason.substr(0, reason.find('[')), GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(
    All, VastPolygon,
    testing::Values(
        Change{"whole", "", [](WorldPolygon&) {}},
        Change{"holesThatTouch", "",
               [](WorldPolygon& p) {
                   p.interiors.push_back(hole(300, 10, 310, 20));
                   p.interiors.push_back(hole(310, 20, 320, 30));
               }},
        Change{"holeThatTouchesTheExterior", "",
               [](WorldPolygon& p) {
                   p.interiors.push_back({{500, 0}, {490, 10}, {500, 20}, {510, 10}});
               }},
        Change{"holesInACircle", "Interior is disconnected",
               [](WorldPolygon& p) {
                   p.interiors.push_back(hole(300, 10, 310, 20));
                   p.interiors.push_back(hole(310, 20, 320, 30));
                   p.interiors.push_back(hole(300, 30, 310, 40));
                   p.interiors.push_back(hole(290, 20, 300, 30));
               }},
        Change{"holeOutside", "Hole lies outside shell or in another hole",
               [](WorldPolygon& p) { p.interiors.push_back(hole(300, 400, 310, 410)); }},
        Change{"holeBetweenTeeth", "Hole lies outside shell or in another hole",
               [](WorldPolygon& p) { p.interiors.push_back(hole(300.25, 260, 300.75, 270)); }},
        Change{"holeInAHole", "Hole lies outside shell or in another hole",
               [](WorldPolygon& p) { p.interiors.push_back(hole(2, 2, 3, 3)); }},
        Change{"holeTwice", "Self-intersection",
               [](WorldPolygon& p) { p.interiors.push_back(p.interiors.front()); }},
        Change{"holeAcrossTheExterior", "Self-intersection",
               [](WorldPolygon& p) { p.interiors.push_back(hole(300, -5, 310, 5)); }},
        Change{"exteriorThatMeetsItself", "Ring Self-intersection",
               [](WorldPolygon& p) {
                   p.exterior.insert(p.exterior.begin() + 1, {{600, 0}, {650, -50}, {550, -50}, {600, 0}});
               }}),
    [](const testing::TestParamInfo<Change>& change) { return std::string(change.param.name); });

TEST(VastPolygons, InTheHolesOfOthersAreValidAndAcrossThemAreNot) {
    WorldPolygon polygon = comb();
    polygon.interiors.push_back(hole(300, 10, 400, 110));
    Geos geos;
    EXPECT_EQ(geos.invalidity({polygon, box(310, 20, 390, 100)}), "");
    EXPECT_NE(geos.invalidity({polygon, box(310, 20, 410, 100)}), "");
    EXPECT_NE(geos.invalidity({polygon, box(2.5, 2.5, 3.5, 3.5), box(500, 10, 510, 20)}), "");
}

}  // namespace
}  // namespace d2b
