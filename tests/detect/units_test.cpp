#include "detect/units.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace d2b::detect {
namespace {

SeenObject seen(double confidence, std::int64_t own_cells) {
    return {{confidence, CounterEvidence::rough, 1000}, confidence >= 0.5, 100 * confidence, own_cells};
}

using Row = std::vector<Label>;

TEST(UnitMerger, OneUnitIsAsItWas) {
    UnitMerger merger;
    const std::vector<SeenObject> objects{seen(0.9, 10), seen(0.8, 20), seen(0.2, 30)};
    EXPECT_EQ(merger.add(objects), 0U);
    const UnitMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.buildings, 2U);
    ASSERT_EQ(merged.objects.size(), 3U);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 3}));
    EXPECT_EQ(merged.objects[1].object.confidence, 0.8);
    EXPECT_EQ(merged.objects[1].object.cells, 20);
}

TEST(UnitMerger, WhoOwnsMoreOfItSaysWhatItIs) {
    UnitMerger merger;
    EXPECT_EQ(merger.add(std::vector{seen(0.3, 10), seen(0.9, 4)}), 0U);
    EXPECT_EQ(merger.add(std::vector{seen(0.7, 90), seen(0.1, 80)}), 2U);
    merger.compare(Row{0, 1, 1, 1, 0, 2, 2}, Row{0, 3, 3, 3, 0, 4, 4});
    const UnitMerger::Merged merged = merger.finish(1);
    ASSERT_EQ(merged.objects.size(), 2U);
    EXPECT_EQ(merged.buildings, 1U);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 1, 2}));
    EXPECT_EQ(merged.objects[0].object.confidence, 0.7);
    EXPECT_EQ(merged.objects[0].own_cells, 100);
    EXPECT_EQ(merged.objects[1].object.confidence, 0.1);
    EXPECT_EQ(merged.objects[1].own_cells, 84);
}

TEST(UnitMerger, OfThoseThatOwnAsMuchTheFirstSaysWhatItIs) {
    UnitMerger merger;
    for (const double confidence : {0.6, 0.9, 0.7})
        merger.add(std::vector{seen(confidence, 30)});
    merger.compare(Row{2, 2}, Row{3, 3});
    merger.compare(Row{1, 1}, Row{2, 2});
    const UnitMerger::Merged merged = merger.finish(1);
    ASSERT_EQ(merged.objects.size(), 1U);
    EXPECT_EQ(merged.objects[0].object.confidence, 0.6);
    EXPECT_EQ(merged.objects[0].own_cells, 90);
}

TEST(UnitMerger, AFewCellsOfANeighbourDoNotJoinIt) {
    UnitMerger merger;
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 50)});
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 50)});
    // The border between the two lies a cell farther to the right as the second unit sees it.
    merger.compare(Row{1, 1, 1, 1, 2, 2, 2, 2}, Row{3, 3, 3, 3, 3, 4, 4, 4});
    const UnitMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 1, 2}));
}

TEST(UnitMerger, SetsGrowOverSeveralSeams) {
    UnitMerger merger;
    for (int unit = 0; unit < 3; ++unit)
        merger.add(std::vector{seen(0.9, 20), seen(0.8, 10)});
    merger.compare(Row{1, 0, 2}, Row{3, 0, 3});  // a courtyard is open above
    merger.compare(Row{3, 3, 0}, Row{5, 5, 0});
    const UnitMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.number, (Row{0, 1, 1, 1, 2, 1, 3}));
    EXPECT_EQ(merged.objects[0].own_cells, 20 + 10 + 20 + 20);
}

/// Of the parts of two buildings that a seam cuts, one unit owns some and the next one others: they belong
/// together as one unit that sees all of them has it. A building with one part is its own whole.
TEST(UnitMerger, PartsOfABuildingStayTogether) {
    const auto part = [](Label whole) {
        SeenObject object = seen(0.9, 10);
        object.object.whole = whole;
        return object;
    };
    UnitMerger merger;
    merger.add(std::vector{part(7), part(3), part(7), part(3)});
    merger.add(std::vector{part(1), part(2), part(2), part(9)});
    // The second part of the building 7 is the first of the building 2, which has another part beyond.
    merger.compare(Row{0, 3, 3, 3, 0}, Row{0, 6, 6, 6, 0});
    const UnitMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 3, 4, 5, 3, 6, 7}));
    Row wholes;
    for (const SeenObject& object : merged.objects)
        wholes.push_back(object.object.whole);
    EXPECT_EQ(wholes, (Row{1, 2, 1, 2, 5, 1, 7}));
    EXPECT_EQ(merged.wholes, (Row{0, 1, 2, 1, 2, 5, 1, 1, 8}));
}

TEST(UnitMerger, SliversAreLeftOut) {
    UnitMerger merger;
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 0), seen(0.9, 9)});
    const UnitMerger::Merged merged = merger.finish(10);
    EXPECT_EQ(merged.number, (Row{0, 1, 0, 0}));
    EXPECT_EQ(merged.objects.size(), 1U);
}

/// A window of 40 x 30 cells at row 100 and column 7, in units of at most 15 cells a side that see it all.
const Window whole_window{100, 7, 40, 30};
const UnitGrid unit_grid(whole_window, {1, 1}, 0, {0, 15});

/// Calls for each unit, in order.
template <typename Use>
void for_units(const Use& use) {
    for (std::int32_t row = 0; row < unit_grid.rows(); ++row)
        for (std::int32_t col = 0; col < unit_grid.cols(); ++col)
            use(unit_grid.unit(row, col), col);
}

TEST(UnitSeams, AreComparedInBothDirections) {
    ASSERT_EQ(unit_grid.rows(), 3);
    ASSERT_EQ(unit_grid.cols(), 2);
    // Rows 113 and 126 and column 22 begin units. Of three objects one lies around the first corner, one
    // crosses the second of the horizontal seams, and one touches the vertical seam from the left.
    Grid<Label> scene(40, 30);
    const auto fill = [&](const Window& cells, Label label) {
        for (std::int32_t r = cells.row; r < cells.end_row(); ++r)
            for (std::int32_t c = cells.col; c < cells.end_col(); ++c)
                scene.at(r, c) = label;
    };
    fill({10, 12, 6, 6}, 1);
    fill({20, 3, 10, 4}, 2);
    fill({30, 10, 5, 5}, 3);
    UnitMerger merger;
    UnitSeams seams(unit_grid.cols());
    for_units([&](const Unit& unit, std::int32_t col) {
        UnitEdges edges = edges_of(unit, scene);
        edges.add(merger.add(std::vector(3, seen(0.9, 10))));
        seams.add(col, std::move(edges), merger);
    });
    const UnitMerger::Merged merged = merger.finish(1);
    const auto number = [&](std::size_t unit, std::size_t object) {
        return merged.number[3 * unit + object];
    };
    // The units that meet at a corner have seen the object around it as one: none has been told apart.
    for (const std::size_t unit : {1U, 2U, 3U})
        EXPECT_EQ(number(unit, 1), number(0, 1));
    EXPECT_NE(number(4, 1), number(0, 1));  // nothing of it lies beside that unit's seams
    EXPECT_EQ(number(4, 2), number(2, 2));
    EXPECT_EQ(number(5, 3), number(4, 3));
    EXPECT_NE(number(5, 2), number(4, 2));
    EXPECT_NE(number(4, 1), number(4, 2));
    EXPECT_NE(number(4, 2), number(4, 3));
}

TEST(LabelRows, ComeBackWithOtherNumbers) {
    Grid<Label> scene(40, 30);
    std::vector<Label> number(5);
    for (std::size_t i = 0; i < scene.values.size(); ++i)
        scene.values[i] = static_cast<Label>(i * i / 7 % 5);
    number = {0, 7, 0, 9, 2};
    LabelRows rows(std::make_unique<MemorySpool>(), whole_window);
    Executor threads(2);
    for_units([&](const Unit& unit, std::int32_t) {
        ASSERT_EQ(unit.seen, whole_window);
        rows.append(unit, scene, threads);
    });
    rows.renumber(number);
    for (const RowBand band : {RowBand{100, 140}, RowBand{100, 101}, RowBand{112, 114}, RowBand{139, 140},
                               RowBand{115, 117}, RowBand{105, 133}}) {
        const LabelBand labels = rows.band({band.begin, band.end - band.begin, 30});
        ASSERT_EQ(labels.labels.size(), static_cast<std::size_t>(band.end - band.begin) * 30);
        for (std::size_t i = 0; i < labels.labels.size(); ++i)
            ASSERT_EQ(labels.labels[i],
                      number[scene.values[static_cast<std::size_t>(band.begin - 100) * 30 + i]])
                << band.begin << " " << i;
    }
}

/// Stretches of an axis that units own and see, from the borders of their windows.
struct Stretch {
    std::int32_t begin;
    std::int32_t end;
    friend bool operator==(const Stretch&, const Stretch&) = default;
};

std::vector<Stretch> rows_seen(const UnitGrid& units) {
    std::vector<Stretch> rows;
    for (std::int32_t row = 0; row < units.rows(); ++row)
        rows.push_back({units.unit(row, 0).seen.row, units.unit(row, 0).seen.end_row()});
    return rows;
}
std::vector<Stretch> cols_seen(const UnitGrid& units) {
    std::vector<Stretch> cols;
    for (std::int32_t col = 0; col < units.cols(); ++col)
        cols.push_back({units.unit(0, col).seen.col, units.unit(0, col).seen.end_col()});
    return cols;
}

/// Cells that all units see, for each cell of the window.
double seen_share(const UnitGrid& units, const Window& window) {
    double down = 0;
    double across = 0;
    for (const auto& [begin, end] : rows_seen(units))
        down += end - begin;
    for (const auto& [begin, end] : cols_seen(units))
        across += end - begin;
    return down / window.rows * (across / window.cols);
}

TEST(UnitGrid, ASmallWindowIsOne) {
    const Window window{100, 7, 1000, 2000};
    const UnitGrid units(window, {1, 1}, 300, {2'000'000, 10});
    ASSERT_EQ(units.count(), 1);
    EXPECT_EQ(units.unit(0, 0).own, window);
    EXPECT_EQ(units.unit(0, 0).seen, window);
    EXPECT_EQ(units.most_seen(), 2'000'000);
}

TEST(UnitGrid, CoversTheWindowAndSeesMore) {
    // 2,101 rows in units of at most 600 are four; 300 m are 150 rows and 75 columns of these cells.
    const UnitGrid units({50, 20, 2101, 700}, {4, 2}, 300, {1'000'000, 600});
    ASSERT_EQ(units.rows(), 4);
    ASSERT_EQ(units.cols(), 2);
    std::int32_t row = 50;
    for (std::int32_t i = 0; i < 4; ++i) {
        std::int32_t col = 20;
        for (std::int32_t j = 0; j < 2; ++j) {
            const auto [own, seen] = units.unit(i, j);
            EXPECT_EQ(own.row, row);
            EXPECT_EQ(own.col, col);
            EXPECT_TRUE(own.rows == 525 || own.rows == 526);
            EXPECT_EQ(own.cols, 350);
            EXPECT_EQ(seen.row, std::max(own.row - 150, 50));
            EXPECT_EQ(seen.end_row(), std::min(own.end_row() + 150, 2151));
            EXPECT_EQ(seen.col, std::max(own.col - 75, 20));
            EXPECT_EQ(seen.end_col(), std::min(own.end_col() + 75, 720));
            col = own.end_col();
        }
        EXPECT_EQ(col, 720);
        row = units.unit(i, 0).own.end_row();
    }
    EXPECT_EQ(row, 2151);
    EXPECT_EQ(units.most_seen(), (525 + 2 * 150) * (350 + 75));
}

TEST(UnitGrid, SeesSomeCellsAroundHoweverLargeTheyAre) {
    const UnitGrid units({0, 0, 640, 40}, {1000, 1000}, 300, {0, 300});
    EXPECT_EQ(rows_seen(units), (std::vector<Stretch>{{0, 277}, {149, 490}, {362, 640}}));
    EXPECT_EQ(cols_seen(units), (std::vector<Stretch>{{0, 40}}));
    // And no more than there are.
    EXPECT_EQ(rows_seen(UnitGrid({0, 0, 640, 40}, {1, 1}, 1e9, {0, 300})),
              (std::vector<Stretch>{{0, 640}, {0, 640}, {0, 640}}));
}

TEST(UnitGrid, SeesLittleMoreThanThereIsWhateverTheShape) {
    // Of 100 million points and more; the columns of units of every number, just divided or nearly again.
    for (const std::int32_t cols :
         {1, 700, 1722, 6144, 6145, 8300, 10000, 12288, 12289, 40000, 100000, 316228})
        for (const std::int64_t points : {100'000'000LL, 100'010'000LL, 1'000'000'000LL, 100'000'000'000LL}) {
            const std::int64_t rows = (points + cols - 1) / cols;
            if (rows > 2'000'000'000)
                continue;
            const Window window{0, 0, static_cast<std::int32_t>(rows), cols};
            const UnitGrid metre(window, {1, 1}, 300);
            EXPECT_LE(seen_share(metre, window), 1.25) << rows << " x " << cols;
            EXPECT_LE(metre.most_seen(), std::int64_t{48} << 20);
            EXPECT_LE(seen_share(UnitGrid(window, {0.5, 0.5}, 300), window), 1.5) << rows << " x " << cols;
            for (const std::int32_t row : {0, metre.rows() - 1})
                for (const std::int32_t col : {0, metre.cols() - 1}) {
                    const Window own = metre.unit(row, col).own;
                    EXPECT_GE(own.rows, std::min(window.rows, 1024));
                    EXPECT_GE(own.cols, std::min(window.cols, 1024));
                    EXPECT_LE(std::max(own.rows, own.cols), 6144);
                }
        }
}

TEST(UnitGrid, GoesToTheLastRowOfTheLargestRaster) {
    const UnitGrid units({0, 0, 2147483647, 1}, {1, 1}, 300);
    EXPECT_EQ(units.unit(units.rows() - 1, 0).own.end_row(), 2147483647);
    EXPECT_EQ(units.unit(units.rows() - 1, 0).seen.end_row(), 2147483647);
}

}  // namespace
}  // namespace d2b::detect
