#include <atomic>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "geometry/geos.hpp"
#include "support/box.hpp"

/// Asked by LeakSanitizer. GEOS 3.11 forgets the noder of a buffer in whose midst it is stopped.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:geos::operation::buffer::BufferBuilder::getNoder\n";
}

namespace d2b {
namespace {

using test::box;

/// GEOS 3.13 asks once per 100,000 pairs of stretches, older ones at each stretch.
bool asks_seldom() {
    return std::string(geos_version()) >= "3.13";
}

/// A number of teeth at which GEOS asks often.
int many() {
    return asks_seldom() ? 400'000 : 5000;
}

/// A polygon with so many teeth; GEOS divides its ring into stretches that go up or down.
WorldPolygon saw(int teeth) {
    WorldPolygon polygon;
    for (int i = 0; i < teeth; ++i)
        for (const Position p : {Position{2.0 * i, 0}, Position{2.0 * i + 1, 1}})
            polygon.exterior.push_back(p);
    polygon.exterior.push_back({2.0 * teeth, 0});
    polygon.exterior.push_back({2.0 * teeth, 5});
    polygon.exterior.push_back({0, 5});
    return polygon;
}

TEST(StoppedGeos, EndsWithACancelledInTheMidstOfACall) {
    int asked = 0;
    bool stops = false;
    const int first = asks_seldom() ? 2 : 100;  // which is more than before and after the call
    Geos geos(StopToken([&] { return ++asked > first && stops; }));
    EXPECT_EQ(geos.invalidity({saw(many())}), "");
    EXPECT_GT(asked, asks_seldom() ? 4 : 1000);
    stops = true;
    asked = 0;
    EXPECT_THROW(static_cast<void>(geos.invalidity({saw(many())})), Cancelled);
    EXPECT_LT(asked, 200);
    asked = 0;
    EXPECT_THROW(static_cast<void>(geos.area_outside(saw(many()), box(10, 0, 20, 4))), Cancelled);
    asked = 0;
    EXPECT_THROW(static_cast<void>(geos.repaired({saw(many())})), Cancelled);
    stops = false;
    EXPECT_EQ(geos.invalidity({saw(many())}), "");
}

TEST(StoppedGeos, AThreadIsNotStoppedByAnother) {
    std::atomic<bool> ends = false;
    std::atomic<int> stopped = 0;
    std::thread other([&] {
        while (!ends) {
            Geos geos(StopToken([] { return true; }));
            EXPECT_THROW(static_cast<void>(geos.invalidity({saw(200)})), Cancelled);
            ++stopped;
        }
    });
    Geos geos(StopToken([] { return false; }));
    for (int i = 0; i < 200 || stopped < 200; ++i)
        EXPECT_EQ(geos.invalidity({saw(200)}), "");
    ends = true;
    other.join();
}

TEST(StoppedGeos, WhoElseRegisteredACallbackKeepsIt) {
    // A second object, an end of the first: GEOS still asks.
    int asked = 0;
    const StopToken stop([&] {
        ++asked;
        return false;
    });
    auto first = std::make_unique<Geos>(stop);
    Geos second(stop);
    first.reset();
    EXPECT_EQ(second.invalidity({saw(many())}), "");
    EXPECT_GT(asked, asks_seldom() ? 2 : 100);
}

}  // namespace
}  // namespace d2b
