#include "core/undeclared_nodata.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace d2b {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::int32_t side = 100;

/// Elevations of 100 x 100 cells.
std::vector<double> grid(const std::function<double(int, int)>& at) {
    std::vector<double> values;
    for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c)
            values.push_back(at(r, c));
    return values;
}

/// Ground at some 20 m, uneven to the last bit, with a house.
double land(int r, int c) {
    const bool house = r >= 70 && r < 82 && c >= 60 && c < 75;
    return 20 + 0.01 * std::sin(7.0 * r + 3.0 * c) + (house ? 8 : 0);
}

UndeclaredNodata found_in(const std::vector<double>& values, double step = 2, double breadth = 60) {
    const Window window{5, 7, side, side};
    const ReadValues read = [&](const Window& part, std::span<double> to) {
        for (std::int32_t r = 0; r < part.rows; ++r)
            std::copy_n(
                values.begin() + std::ptrdiff_t{part.row - window.row + r} * side + part.col - window.col,
                part.cols, to.begin() + std::ptrdiff_t{r} * part.cols);
    };
    return find_undeclared_nodata(window, read_border(window, read), {step, breadth}, read);
}

/// Values taken for no data in land of which a part has a value.
std::vector<double> taken(const std::function<bool(int, int)>& is_in, double value) {
    return found_in(grid([&](int r, int c) { return is_in(r, c) ? value : land(r, c); })).values();
}

TEST(UndeclaredNodata, AreTakenAtAnyElevation) {
    for (const double value : {0.0, 255.0, -1.0, 1e-3, 8000.0, 17.0}) {
        const std::vector<double> one{value};
        EXPECT_EQ(taken([](int, int c) { return c < 12; }, value), one);
        EXPECT_EQ(taken([](int r, int c) { return r + c < 50; }, value), one);
        EXPECT_EQ(
            taken([](int r, int c) { return std::abs(r + c - 99) > 60 || std::abs(r - c) > 60; }, value),
            one);
        EXPECT_EQ(taken([](int r, int c) { return std::hypot(r - 49.5, c - 49.5) > 45; }, value), one);
    }
    EXPECT_TRUE(taken([](int, int c) { return c < 12; }, 19).empty()) << "a step of 1 m";
}

TEST(UndeclaredNodata, AreTakenBesideElevationsInWholeMetres) {
    // The border of the land has one elevation and two houses, so it looks like no data there, too.
    const auto whole = [](int r, int c) {
        const bool house = r < 5 && c > 30 && c < 84 && c / 9 % 2 == 0;
        const bool border = r < 3 || r > 96 || c > 96;
        return house ? 48.0 : border || (r / 5 + c / 5) % 2 == 0 ? 40.0 : 41.0;
    };
    const std::vector<double> values = grid([&](int r, int c) { return c < 20 ? 0 : whole(r, c); });
    EXPECT_EQ(found_in(values, 2, 20).values(), std::vector<double>{0});
    EXPECT_TRUE(found_in(grid(whole), 2, 20).values().empty());
}

TEST(UndeclaredNodata, AreTakenInsideDeclaredNodata) {
    const auto from_edge = [](int r, int c) { return std::min({r, c, 99 - r, 99 - c}); };
    EXPECT_EQ(found_in(grid([&](int r, int c) {
                  return from_edge(r, c) < 6 ? none : from_edge(r, c) < 14 ? 0 : land(r, c);
              })).values(),
              std::vector<double>{0});
    EXPECT_EQ(found_in(grid([&](int r, int c) { return c < 10   ? none
                                                       : c < 22 ? 0
                                                                : land(r, c); })).values(),
              std::vector<double>{0});
    // A flat roof at a cutline.
    EXPECT_TRUE(found_in(grid([&](int r, int c) {
                    return from_edge(r, c) < 6 ? none : r < 40 && c < 40 ? 31 : land(r, c);
                })).none());
    // A pond of one elevation around a gap that does not reach the edge.
    EXPECT_TRUE(found_in(grid([&](int r, int c) {
                    const double away = std::hypot(r - 50, c - 50);
                    return from_edge(r, c) < 2 ? none : away < 5 ? none : away < 22 ? 12 : land(r, c);
                })).none());
}

TEST(UndeclaredNodata, AreTakenInsideOthers) {
    const std::vector<double> values = grid([](int r, int c) {
        const int from_edge = std::min({r, c, 99 - r, 99 - c});
        return from_edge < 6 ? -99 : from_edge < 14 ? 0 : land(r, c);
    });
    const UndeclaredNodata found = found_in(values);
    EXPECT_EQ(found.values(), (std::vector<double>{-99, 0}));
    EXPECT_EQ(found.taken[1].cells, 88 * 88 - 72 * 72);
}

TEST(UndeclaredNodata, SurroundAnyNumberOfSurveyedAreas) {
    // Nine squares of 28 cells.
    const auto is_between = [](int r, int c) { return r % 33 < 4 || c % 33 < 4 || r == 99 || c == 99; };
    EXPECT_EQ(found_in(grid([&](int r, int c) { return is_between(r, c) ? 0 : land(r, c); }), 2, 20).values(),
              std::vector<double>{0});
    EXPECT_TRUE(found_in(grid([&](int r, int c) { return is_between(r, c) ? 0 : 20; }), 2, 60).none())
        << "houses in a plain";
}

TEST(UndeclaredNodata, MayBeNextToCellsThatResamplingMadeNearlyEqual) {
    // Overshoot, as of cubic convolution: the values on a line across the edge are 0, -1.2, 9 and 20.
    const auto resampled = [](int distance, double value) {
        return distance < 0 ? 0 : distance == 0 ? -0.06 * value : distance == 1 ? value * 0.45 : value;
    };
    EXPECT_EQ(found_in(grid([&](int r, int c) {
                  return resampled(std::min({r, c, 99 - r, 99 - c}) - 12, land(r, c));
              })).values(),
              std::vector<double>{0});
    EXPECT_EQ(found_in(grid([&](int r, int c) { return resampled(r - 30, land(r, c)); })).values(),
              std::vector<double>{0});
    EXPECT_EQ(found_in(grid([&](int r, int c) { return resampled(69 - r, land(r, c)); })).values(),
              std::vector<double>{0});
}

/// A hole of 0 in a level terrain is not land, although it has one value as well.
TEST(UndeclaredNodata, AreNotLevelLandAroundAHole) {
    const auto level = [](int least) {
        return found_in(grid([=](int r, int c) {
                            return r >= least && r < 100 - least && c >= least && c < 100 - least ? 0 : 50;
                        }),
                        2, 0);
    };
    EXPECT_TRUE(level(30).none());
    EXPECT_EQ(level(10).values(), std::vector<double>{50}) << "the larger part is land";
}

TEST(UndeclaredNodata, AreCountedWhereTheyReachTheEdge) {
    const UndeclaredNodata found = found_in(
        grid([](int r, int c) { return c < 12 || (r > 90 && r < 95 && c > 90 && c < 95) ? 0 : land(r, c); }));
    ASSERT_EQ(found.taken.size(), 1U);
    EXPECT_EQ(found.taken[0].cells, 1200);
    EXPECT_TRUE(found.named.empty());
}

TEST(UndeclaredNodata, SmallerOnesAreNamedAlone) {
    for (const int columns : {1, 9}) {
        const UndeclaredNodata found =
            found_in(grid([&](int r, int c) { return c < columns ? 0 : land(r, c); }));
        EXPECT_TRUE(found.taken.empty());
        ASSERT_EQ(found.named.size(), 1U);
        EXPECT_EQ(found.named[0].value, 0);
        EXPECT_EQ(found.named[0].cells, 100 * columns);
    }
    EXPECT_TRUE(found_in(grid([](int r, int c) { return c < 1 && r < 99 ? 0 : land(r, c); })).none());
}

TEST(UndeclaredNodata, SeveralAreTakenAtATime) {
    const UndeclaredNodata found = found_in(grid([](int r, int c) {
        return c < 15 ? 0 : c >= 85 ? 255 : r < 2 ? -7 : land(r, c);
    }));
    EXPECT_EQ(found.values().size(), 2U);
    EXPECT_EQ(found.named.size(), 1U);
}

TEST(UndeclaredNodata, CellsOfDeclaredNoDataCountForNothing) {
    const UndeclaredNodata found = found_in(grid([](int r, int c) {
        return c >= 20 && c < 70 && r > 2 ? none : c < 6 ? 0 : land(r, c);
    }));
    ASSERT_EQ(found.taken.size(), 1U);  // 600 of 5,150 valid cells
    EXPECT_EQ(found.taken[0].cells, 600);
}

TEST(UndeclaredNodata, ASeaWithAShoreStays) {
    const auto coast = [](double slope) {
        return found_in(grid([=](int r, int c) {
            return c < 40 ? 0 : slope * (c - 39) + 0.01 * std::sin(7.0 * r + 3.0 * c) + 0.02;
        }));
    };
    EXPECT_TRUE(coast(0.1).none());
    EXPECT_TRUE(coast(1).none());
    // A quay along two thirds of it.
    EXPECT_TRUE(found_in(grid([](int r, int c) {
                    return c < 40 ? 0
                                  : (r < 66 ? 4 : 0.2) + 0.1 * (c - 40) + 0.01 * std::sin(7.0 * r + 3.0 * c);
                })).none());
}

TEST(UndeclaredNodata, APlainWithHousesStays) {
    const auto houses = [](int r, int c) { return r % 25 > 8 && r % 25 < 20 && c % 30 > 8 && c % 30 < 24; };
    EXPECT_TRUE(found_in(grid([&](int r, int c) { return houses(r, c) ? land(r, c) : 0; })).none());
    EXPECT_TRUE(found_in(grid([&](int r, int c) { return houses(r, c) ? 9 : 0; })).none());
    const auto one = [](int r, int c) { return r > 30 && r < 70 && c > 20 && c < 70; };
    EXPECT_TRUE(found_in(grid([&](int r, int c) { return one(r, c) ? land(r, c) : 0; })).none());
}

TEST(UndeclaredNodata, WhatDoesNotReachTheEdgeStays) {
    EXPECT_TRUE(found_in(grid([](int r, int c) {
                    return r > 20 && r < 80 && c > 20 && c < 80 ? 0 : land(r, c);
                })).none());
    EXPECT_TRUE(found_in(std::vector<double>(side * side, 0)).none());
    EXPECT_TRUE(found_in(std::vector<double>(side * side, none)).none());
}

TEST(UndeclaredNodata, OfAModelNothingStandsOnNeedNotSurroundMuch) {
    const std::vector<double> values = grid([](int r, int c) { return r + c < 150 ? 0 : land(r, c); });
    EXPECT_EQ(found_in(values, 2, 0).taken.size(), 1U);
}

TEST(UndeclaredNodata, ALevelTerrainIsLand) {
    const auto found = [](int columns) {
        return found_in(grid([=](int, int c) { return c < columns ? 0 : 300; }), 2, 0);
    };
    ASSERT_EQ(found(50).taken.size(), 1U);
    EXPECT_EQ(found(50).taken[0].value, 0);
    ASSERT_EQ(found(4).named.size(), 1U);
    EXPECT_EQ(found(4).named[0].value, 0);
    EXPECT_TRUE(found(4).taken.empty());
}

TEST(UndeclaredNodata, RoundedElevationsHaveNone) {
    EXPECT_TRUE(found_in(grid([](int r, int c) { return std::floor(20 + 0.05 * r + 0.03 * c); })).none());
}

TEST(UndeclaredNodata, ElevationsRoundedToLargeStepsAreLand) {
    const auto rounded = [](int r, int c) { return 5 * std::floor((20 + 0.4 * r + 0.1 * c) / 5); };
    const auto bands = [](int r, int) { return 5 * std::floor((20 + 0.4 * r) / 5); };
    EXPECT_TRUE(found_in(grid(rounded), 2, 0).none());
    EXPECT_TRUE(found_in(grid(rounded), 2, 20).none());
    EXPECT_TRUE(found_in(grid(bands), 2, 0).none());
    const std::vector<double> surrounded = grid([&](int r, int c) {
        return std::min({r, c, 99 - r, 99 - c}) < 10 ? 0 : rounded(r, c);
    });
    EXPECT_EQ(found_in(surrounded, 2, 0).values(), std::vector<double>{0});
}

TEST(UndeclaredNodata, AreTakenBesideRoundedElevations) {
    for (const double step : {0.5, 1.0, 2.0})
        for (const int rows : {97, 94, 91, 88}) {
            const auto rounded = [=](int r, int c) {
                return step * std::round((land(r, c) + 0.06 * r + 0.09 * c) / step);
            };
            EXPECT_TRUE(found_in(grid(rounded), 2, 20).none());
            const UndeclaredNodata found = found_in(
                grid([&](int r, int c) { return r >= rows          ? none
                                                : c < 20 || r < 10 ? 0
                                                                   : rounded(r, c); }),
                2, 60);
            EXPECT_EQ(found.values(), std::vector<double>{0}) << "steps of " << step << ", rows " << rows;
            EXPECT_TRUE(found.named.empty());
        }
}

/// Level ground at 20 m with houses on a third of it.
double level_land(int r, int c) {
    const bool house = r % 20 > 5 && r % 20 < 18 && c % 25 > 5 && c % 25 < 20;
    return house ? 27.0 + r / 20 : 20.0;
}

TEST(UndeclaredNodata, AreTakenBesideLevelGround) {
    const auto beside_level_land = [](const std::function<bool(int, int)>& is_in, double value) {
        return found_in(grid([&](int r, int c) { return is_in(r, c) ? value : level_land(r, c); }), 2, 40);
    };
    const auto strip = [](int, int c) { return c < 20; };
    const auto corners = [](int r, int c) { return std::abs(r + c - 99) > 70 || std::abs(r - c) > 70; };
    for (const double value : {0.0, -1.0, 12.0}) {
        EXPECT_EQ(beside_level_land(strip, value).values(), std::vector<double>{value});
        EXPECT_EQ(beside_level_land(corners, value).values(), std::vector<double>{value});
    }
    EXPECT_TRUE(beside_level_land(strip, 19).none()) << "a step of 1 m";
    EXPECT_TRUE(beside_level_land(strip, 31).none()) << "a roof is above the ground";
    EXPECT_TRUE(found_in(grid(level_land), 2, 40).none());
}

}  // namespace
}  // namespace d2b
