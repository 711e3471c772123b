#include "detect/parcel_fit.hpp"

#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "core/context.hpp"

namespace d2b::diagnose {
namespace {

/// Blocks of one height and single towers, and parcels that are the same moved.
struct Quarter {
    Quarter(std::int32_t side, CellSize cell_size) : cell(cell_size), surface(side, side, 100) {
        terrain = surface;
        found.labels = Grid<Label>(side, side);
        found.buildings = 1;
        parcels = detect::ParcelGrid(side, side);
    }
    /// @param at metres: top, left, height, width
    void build(double top, double left, double high, double wide, std::int64_t number) {
        for_box(top, left, high, wide, [&](std::int32_t r, std::int32_t c) {
            surface.at(r, c) = 110;
            found.labels.at(r, c) = 1;
        });
        for_box(top + down, left + right, high, wide,
                [&](std::int32_t r, std::int32_t c) { parcels.at(r, c).parcel = number; });
    }
    template <typename Use>
    void for_box(double top, double left, double high, double wide, const Use& use) const {
        const auto cells = [](double metres, double size) {
            return static_cast<std::int32_t>(std::lround(metres / size));
        };
        for (std::int32_t r = cells(top, cell.down); r < cells(top + high, cell.down); ++r)
            for (std::int32_t c = cells(left, cell.across); c < cells(left + wide, cell.across); ++c)
                use(r, c);
    }
    [[nodiscard]] detect::ShiftCounts counts(const Window& own) const {
        Context context;
        detect::Scene scene{surface, terrain, cell};
        scene.parcels = &parcels;
        detect::ShiftCounts counts;
        detect::count_shifts(scene, found, own, counts, *context.threads);
        return counts;
    }
    [[nodiscard]] std::optional<ParcelMove> move() const {
        return detect::best_offset(counts({0, 0, surface.rows, surface.cols}), cell);
    }

    CellSize cell;
    MetreGrid surface;
    MetreGrid terrain;
    detect::Detection found;
    detect::ParcelGrid parcels;
    double right = 0;  ///< of the parcels, metres
    double down = 0;
};

Quarter houses(double right, double down, std::int32_t side, CellSize cell) {
    Quarter quarter(side, cell);
    quarter.right = right;
    quarter.down = down;
    std::mt19937 random(3);
    std::int64_t number = 0;
    for (double top = 12; top < 100; top += 24)
        for (double left = 12; left < 100; left += 23) {
            const auto off = [&] { return static_cast<double>(random() % 5); };
            quarter.build(top + off(), left + off(), 8 + off(), 8 + off(), ++number);
        }
    return quarter;
}

TEST(ParcelShift, IsFoundToTheStep) {
    for (const CellSize& cell : {CellSize{1, 1, 1}, CellSize{0.5, 0.5, 1}, CellSize{0.25, 0.5, 1}})
        for (const auto& [right, down] :
             {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(4.0, 0.0), std::pair(-3.0, 5.0)}) {
            const auto side = static_cast<std::int32_t>(130 / cell.across);
            const auto move = houses(right, down, side, cell).move();
            ASSERT_TRUE(move) << cell.across << " " << right << " " << down;
            EXPECT_EQ(move->right_m, -right);
            EXPECT_EQ(move->down_m, -down);
        }
}

TEST(ParcelShift, AlongAStraightRowItIsTheLeast) {
    Quarter row(200, {1, 1, 1});
    row.down = 3;
    for (int house = 0; house < 20; ++house)
        row.build(90, 20 + 8 * house, 12, 8, house);
    const auto move = row.move();
    ASSERT_TRUE(move);
    EXPECT_EQ(move->down_m, -3);
    EXPECT_EQ(move->right_m, 0);
}

TEST(ParcelShift, IsNotSaidOfFewWallsOrOfParcelsWithoutThem) {
    Quarter one(100, {1, 1, 1});
    one.build(40, 40, 10, 10, 1);
    EXPECT_FALSE(one.move());
    EXPECT_FALSE(Quarter(100, {1, 1, 1}).move());
    for (unsigned seed = 0; seed < 8; ++seed) {
        Quarter quarter = houses(0, 0, 130, {1, 1, 1});
        std::mt19937 random(seed);
        const double lean = static_cast<double>(random() % 100) / 100;
        const double width = 9 + static_cast<double>(random() % 60) / 10;
        for (std::int32_t r = 0; r < 130; ++r)
            for (std::int32_t c = 0; c < 130; ++c)
                quarter.parcels.at(r, c).parcel =
                    100 * std::lround((c + lean * r) / width) + std::lround((r - lean * c) / (2 * width));
        EXPECT_FALSE(quarter.move()) << seed;
    }
}

TEST(ParcelShift, PartsAddUpToTheWhole) {
    const Quarter quarter = houses(2, 1, 130, {1, 1, 1});
    detect::ShiftCounts sum = quarter.counts({0, 0, 130, 40});
    sum.merge(quarter.counts({0, 40, 77, 90}));
    sum.merge(quarter.counts({77, 40, 53, 90}));
    EXPECT_EQ(sum.on_walls, quarter.counts({0, 0, 130, 130}).on_walls);
}

}  // namespace
}  // namespace d2b::diagnose
