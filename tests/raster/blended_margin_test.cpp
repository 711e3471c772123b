#include "raster/blended_margin.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace d2b {
namespace {

constexpr double no_data = std::numeric_limits<double>::quiet_NaN();
const ElevationLimits land_limits{-500, 9000};

/// Raster that is given by a function of row and column.
struct Made {
    Window window;
    std::function<double(std::int32_t, std::int32_t)> at;
    std::int64_t cells_read = 0;

    ReadValues reader() {
        return [this](const Window& part, std::span<double> to) {
            cells_read += part.points();
            for (std::int32_t i = 0; i < part.rows; ++i)
                for (std::int32_t j = 0; j < part.cols; ++j)
                    to[static_cast<std::size_t>(i) * static_cast<std::size_t>(part.cols) +
                       static_cast<std::size_t>(j)] = at(part.row + i, part.col + j);
        };
    }
    BlendedMargin find(const MissingValues& missing) {
        return find_blended_margin(window, missing, 2, reader());
    }
};

/// Uneven ground at 50 m with a house in each square of 40 m.
double uneven_town(std::int32_t row, std::int32_t col) {
    const bool house = row % 40 < 12 && col % 40 >= 28;
    return 50 + 0.5 * std::sin(0.7 * row + 0.3 * col) + (house ? 9 : 0);
}

/// Returns a town beyond a number of cells without data. @param shares of land in the cells between
double behind_edge(std::int32_t from_edge, std::int32_t row, std::int32_t col, double missing, double value,
                   const std::vector<double>& shares) {
    constexpr std::int32_t breadth = 12;
    if (from_edge < breadth)
        return missing;
    const auto i = static_cast<std::size_t>(from_edge - breadth);
    const double z = uneven_town(row, col);
    return i < shares.size() ? value + shares[i] * (z - value) : z;
}

/// Cells between land at 50 m and missing ones.
struct Blended {
    double value;
    std::vector<double> shares;  ///< of land
    std::int32_t last;           ///< number of the last cell that no land looks like
};

TEST(BlendedMargin, IsHalfAsBroadAgainAsTheCellsThatAreNoLand) {
    const std::vector<Blended> all{{0, {0.5}, 1},
                                   {-9999, {0.5}, 1},
                                   {300, {0.25, 0.75}, 2},
                                   {0, {-0.07, 0.5, 1.07}, 2},  // a building may have 53 m
                                   {-9999, {-0.07, 0.5}, 2},
                                   {0, {0.2, 0.4, 0.6, 0.8}, 4}};
    for (const Blended& blended : all) {
        const double value = blended.value;
        const std::vector<double>& shares = blended.shares;
        const std::int32_t broad = blended.last + (blended.last + 1) / 2;
        Made left{{3, 5, 200, 150}, [&](std::int32_t row, std::int32_t col) {
                      return behind_edge(col - 5, row, col, no_data, value, shares);
                  }};
        const BlendedMargin known = left.find({value, {}, land_limits});
        EXPECT_EQ(known.cells, broad) << value << ' ' << shares.size();
        EXPECT_EQ(known.with, value);
        const BlendedMargin unknown = left.find({std::nullopt, {}, land_limits});
        EXPECT_EQ(unknown.cells, broad) << value << ' ' << shares.size();
        EXPECT_EQ(unknown.with, std::nullopt);
        Made below{{3, 5, 200, 150}, [&](std::int32_t row, std::int32_t col) {
                       return behind_edge(202 - row, row, col, value, value, shares);
                   }};
        const BlendedMargin found = below.find({std::nullopt, {value}, land_limits});
        EXPECT_EQ(found.cells, broad) << value << ' ' << shares.size();
        EXPECT_EQ(found.missing.front(), value);
        EXPECT_EQ(found.with, value);
    }
}

TEST(BlendedMargin, AValueOutsideOfTheLimitsIsFound) {
    Made made{{0, 0, 200, 150}, [](std::int32_t row, std::int32_t col) {
                  return behind_edge(col, row, col, -9999, -9999, {0.25, 0.75});
              }};
    const BlendedMargin found = made.find({std::nullopt, {}, land_limits});
    EXPECT_EQ(found.cells, 3);
    EXPECT_EQ(found.missing, std::vector<double>{-9999});
}

TEST(BlendedMargin, IsNotFoundWhereNothingIsBlended) {
    for (const double value : {0.0, -9999.0, 300.0}) {
        Made made{{0, 0, 200, 150}, [&](std::int32_t row, std::int32_t col) {
                      return behind_edge(row, row, col, no_data, value, {});
                  }};
        EXPECT_EQ(made.find({value, {}, land_limits}).cells, 0);
    }
    // A raster of buildings alone, the cells along whose walls have half of their heights.
    const auto building = [](std::int32_t row, std::int32_t col) {
        const std::int32_t in = std::min({row % 40, 19 - row % 40, col % 40, 19 - col % 40});
        return in < 0 ? no_data : in == 0 ? 4.0 : 8.0;
    };
    Made buildings{{0, 0, 200, 200}, building};
    EXPECT_EQ(buildings.find({-9999, {}, land_limits}).cells, 0);
}

TEST(BlendedMargin, ATowerWithAHoleIsNoMargin) {
    const auto tower = [](std::int32_t row, std::int32_t col) {
        const std::int32_t away = std::max(std::abs(row - 100), std::abs(col - 80));
        return away < 6 ? no_data : away < 20 ? 130.0 + 0.1 * away : uneven_town(row, col);
    };
    Made made{{0, 0, 200, 150}, tower};
    EXPECT_EQ(made.find({std::nullopt, {}, land_limits}).cells, 0);
    EXPECT_EQ(made.find({-9999, {}, land_limits}).cells, 0);
}

TEST(BlendedMargin, IsFoundInLargeRastersFromStrips) {
    for (const bool along_rows : {false, true})
        for (const bool at_end : {false, true}) {
            constexpr std::int32_t rows = 30000;
            constexpr std::int32_t cols = 60;
            // Some 1,000 rows without data lie between two strips as well.
            Made made{{0, 0, rows, cols}, [&](std::int32_t row, std::int32_t col) {
                          const std::int32_t from = along_rows ? (at_end ? rows - 1 - row : row) - 2900
                                                               : (at_end ? cols - 1 - col : col);
                          return behind_edge(from, row, col, no_data, 0, {0.5});
                      }};
            EXPECT_EQ(made.find({0.0, {}, land_limits}).cells, 2) << along_rows << at_end;
            EXPECT_LT(made.cells_read, std::int64_t{rows} * cols / 8);
        }
}

TEST(BlendedMargin, IsReadTheSameInAnyPartWhereItIsBlended) {
    const BlendedMargin margin{2, {0}, 0, 40, 80};
    // One of three missing cells has a blended one beside it, and the second is near that.
    const auto at = [](std::int32_t row, std::int32_t col) {
        if ((row == 4 && col == 5) || (row == 7 && col == 35))
            return no_data;
        return row == 9 && col == 0 ? 0.0 : row == 4 && col == 6 ? 20.0 : row == 0 && col == 12 ? 30.0 : 50.0;
    };
    Made made{{0, 0, 12, 40}, at};
    const auto expected = [&](std::int32_t row, std::int32_t col) {
        const double z = at(row, col);
        const bool near = (std::abs(row - 4) <= 2 && std::abs(col - 5) <= 2) || (row >= 7 && col <= 2);
        return near && z > 0 ? blended_value : z;
    };
    for (std::int32_t row = 0; row < 12; ++row)
        for (std::int32_t col = 0; col < 40; col += 3)
            for (std::int32_t rows = 1; row + rows <= 12; rows += 3)
                for (std::int32_t cols = 1; col + cols <= 40; cols += 7) {
                    std::vector<double> values(static_cast<std::size_t>(rows * cols));
                    read_without_margin(margin, made.window, {row, col, rows, cols}, values, made.reader());
                    for (std::int32_t i = 0; i < rows * cols; ++i) {
                        const double z = values[static_cast<std::size_t>(i)];
                        const double wanted = expected(row + i / cols, col + i % cols);
                        ASSERT_TRUE(z == wanted || (std::isnan(z) && std::isnan(wanted)));
                    }
                }
}

}  // namespace
}  // namespace d2b
