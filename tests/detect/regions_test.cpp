#include "detect/regions.hpp"

#include <atomic>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "detect/morphology.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::drawing;
using test::drawn;

std::vector<Label> labels_of(const Regions& regions) {
    std::vector<Label> itself(regions.cells.size());
    std::iota(itself.begin(), itself.end(), Label{0});
    const Grid<Label> labels = label_grid(regions, itself, test::threads());
    return {labels.values.begin(), labels.values.end()};
}

/// Floods one region after the other, in scan order of their first cells.
template <typename Joined>
std::vector<Label> flooded(const Mask& in, std::uint8_t value, const Joined& joined) {
    std::vector<Label> labels(in.size(), 0);
    Label last = 0;
    for (std::size_t first = 0; first < in.size(); ++first) {
        if (in.values[first] != value || labels[first] != 0)
            continue;
        std::vector<std::size_t> open{first};
        labels[first] = ++last;
        while (!open.empty()) {
            const std::size_t i = open.back();
            open.pop_back();
            const auto r = static_cast<std::int32_t>(i / static_cast<std::size_t>(in.cols));
            const auto c = static_cast<std::int32_t>(i % static_cast<std::size_t>(in.cols));
            for (const auto& [y, x] : {std::pair{r - 1, c}, {r + 1, c}, {r, c - 1}, {r, c + 1}}) {
                if (!in.holds(y, x))
                    continue;
                const std::size_t j = in.index(y, x);
                if (in.values[j] == value && labels[j] == 0 && joined(std::min(i, j), std::max(i, j))) {
                    labels[j] = last;
                    open.push_back(j);
                }
            }
        }
    }
    return labels;
}

void expect_counts(const Regions& regions, const std::vector<Label>& labels) {
    std::vector<std::int64_t> cells(regions.cells.size(), 0);
    for (const Label label : labels)
        cells.at(label) += label != 0 ? 1 : 0;
    EXPECT_EQ(regions.cells, cells);
}

TEST(Regions, ConnectedLikeAFlood) {
    std::mt19937 random(1);
    for (unsigned i = 0; i < 400; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 30);
        const auto cols = static_cast<std::int32_t>(1 + random() % 70);
        const Mask mask = i % 2 == 0 ? test::random_mask(rows, cols, 30 + i % 70, random)
                                     : test::random_blocks(rows, cols, 30, random);
        for (const std::uint8_t value : {std::uint8_t{1}, std::uint8_t{0}}) {
            const Regions regions = connected_regions(mask, value, 0, test::threads());
            const auto expected = flooded(mask, value, [](auto, auto) { return true; });
            ASSERT_EQ(labels_of(regions), expected) << i;
            expect_counts(regions, expected);
        }
        ASSERT_EQ(drawing(mask_of(connected_regions(mask, 1, 0, test::threads()), test::threads())),
                  drawing(mask))
            << i;
    }
}

TEST(Regions, JoinedLikeAFlood) {
    std::mt19937 random(2);
    for (unsigned i = 0; i < 400; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 20);
        const auto cols = static_cast<std::int32_t>(1 + random() % 50);
        const Mask mask = test::random_mask(rows, cols, 50 + i % 51, random);
        std::vector<int> height(mask.size());
        for (int& h : height)
            h = static_cast<int>(random() % (2 + i % 5));
        const auto joined = [&](std::size_t a, std::size_t b) { return std::abs(height[a] - height[b]) < 2; };
        const Regions regions = joined_regions(mask, joined, test::threads());
        const auto expected = flooded(mask, 1, joined);
        ASSERT_EQ(labels_of(regions), expected) << i;
        expect_counts(regions, expected);
    }
}

TEST(Regions, RunsLieInScanOrderAndDoNotTouchWithinARegion) {
    const Regions regions = connected_regions(drawn({"##.#", "....", "####"}), 1, 0, test::threads());
    ASSERT_EQ(regions.count(), 3U);
    ASSERT_EQ(regions.row(0).size(), 2U);
    EXPECT_EQ(regions.row(0)[1].begin, 3);
    EXPECT_EQ(regions.row(0)[1].end, 4);
    EXPECT_EQ(regions.row(0)[1].label, 2U);
    EXPECT_TRUE(regions.row(1).empty());
    EXPECT_EQ(regions.row(2)[0].end, 4);
    EXPECT_EQ(connected_regions(Mask(), 1, 0, test::threads()).count(), 0U);
}

TEST(Regions, SmallOnesAreLeftOutAndTheOthersKeepTheirOrder) {
    const Mask mask = drawn({"##.###", "......", "#.####", "#....."});
    const Regions regions = connected_regions(mask, 1, 3, test::threads());
    EXPECT_EQ(labels_of(regions),
              (std::vector<Label>{0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(regions.cells, (std::vector<std::int64_t>{0, 3, 4}));
    const Regions none = connected_regions(mask, 1, 5, test::threads());
    EXPECT_EQ(none.count(), 0U);
    EXPECT_TRUE(none.runs.empty());
}

/// Regions of ones by filling them cell by cell, in scan order.
std::vector<Label> filled_one_by_one(const Mask& mask, std::int64_t least) {
    std::vector<Label> labels(mask.size(), 0);
    std::vector<bool> seen(mask.size(), false);
    Label next = 0;
    for (std::size_t first = 0; first < mask.size(); ++first) {
        if (mask.values[first] == 0 || seen[first])
            continue;
        std::vector<std::size_t> cells{first};
        seen[first] = true;
        const auto cols = static_cast<std::size_t>(mask.cols);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const std::size_t i = cells[k];
            const auto visit = [&](bool inside, std::size_t j) {
                if (inside && mask.values[j] != 0 && !seen[j]) {
                    seen[j] = true;
                    cells.push_back(j);
                }
            };
            visit(i % cols > 0, i - 1);
            visit(i % cols + 1 < cols, i + 1);
            visit(i >= cols, i - cols);
            visit(i + cols < mask.size(), i + cols);
        }
        if (static_cast<std::int64_t>(cells.size()) < least)
            continue;
        ++next;
        for (const std::size_t i : cells)
            labels[i] = next;
    }
    return labels;
}

TEST(Regions, BandsAndThreadsDoNotShow) {
    std::mt19937 random(3);
    Mask mask(90, 20000);  // bands of sixteen rows
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = random() % 100 < (i % 20000 < 9000 ? 57 : 62) ? 1 : 0;
    for (const std::int64_t least : {0, 40}) {
        const std::vector<Label> expected = filled_one_by_one(mask, least);
        for (const int count : {1, 2, 5}) {
            Executor threads(count);
            const Regions regions = connected_regions(mask, 1, least, threads);
            ASSERT_TRUE(labels_of(regions) == expected) << count << " threads, at least " << least;
            std::vector<std::int64_t> cells(regions.cells.size(), 0);
            for (const Label label : expected)
                cells[label] += label != 0 ? 1 : 0;
            EXPECT_EQ(regions.cells, cells);
        }
    }
}

TEST(Regions, RunsOfALabelComeInScanOrder) {
    std::mt19937 random(4);
    Mask mask(60, 30000);
    for (std::uint8_t& value : mask.values)
        value = random() % 10 < 6 ? 1 : 0;
    const Regions regions = connected_regions(mask, 1, 0, test::threads());
    std::vector<std::pair<std::int32_t, std::int32_t>> last(regions.cells.size(), {-1, -1});
    std::vector<std::int64_t> cells(regions.cells.size(), 0);
    std::atomic<bool> ordered = true;
    for_runs_by_label(test::threads(), regions, [&](std::int32_t row, const RegionRun& run) {
        const std::pair<std::int32_t, std::int32_t> here{row, run.begin};
        if (!(last[run.label] < here))
            ordered = false;
        last[run.label] = here;
        cells[run.label] += run.end - run.begin;
    });
    EXPECT_TRUE(ordered);
    EXPECT_EQ(cells, regions.cells);
}

TEST(Regions, LabelGridWritesTheNumbersGiven) {
    const Regions regions = connected_regions(drawn({"#.#"}), 1, 0, test::threads());
    EXPECT_EQ(label_grid(regions, std::vector<Label>{0, 7, 0}, test::threads()).values,
              (std::vector<Label>{7, 0, 0}));
}

TEST(LabelSets, SmallestStandsForAll) {
    LabelSets sets;
    for (Label label = 1; label <= 5; ++label)
        EXPECT_EQ(sets.add(), label);
    EXPECT_EQ(sets.join(5, 4), 4U);
    EXPECT_EQ(sets.join(5, 2), 2U);
    EXPECT_EQ(sets.find(4), 2U);
    EXPECT_EQ(sets.join(4, 5), 2U);
    EXPECT_EQ(sets.numbered(), (std::vector<Label>{0, 1, 2, 3, 2, 2}));
}

TEST(Holes, SmallOnesAreFilled) {
    Mask mask = drawn({"#########",  //
                       "#.##..###",  //
                       "####.####",  //
                       "#########"});
    fill_small_holes(mask, 3, test::threads());
    EXPECT_EQ(drawing(mask), drawing(drawn({"#########",  //
                                            "####..###",  //
                                            "####.####",  //
                                            "#########"})))
        << "three cells are not fewer than three";
    fill_small_holes(mask, 4, test::threads());
    EXPECT_EQ(drawing(mask), drawing(Mask(4, 9, 1)));
}

TEST(Holes, ThoseAtTheBorderStay) {
    const Mask mask = drawn({"##.##",  //
                             "#####",  //
                             ".###.",  //
                             "#####",  //
                             "##.##"});
    Mask filled = mask;
    fill_small_holes(filled, 100, test::threads());
    EXPECT_EQ(drawing(filled), drawing(mask));
}

TEST(Holes, DiagonalIsNoWayOut) {
    Mask mask = drawn({"..###",  //
                       "..#.#",  //
                       "###.#",  //
                       "#.###",  //
                       "#####"});
    fill_small_holes(mask, 3, test::threads());
    EXPECT_EQ(drawing(mask), drawing(drawn({"..###", "..###", "#####", "#####", "#####"})));
}

}  // namespace
}  // namespace d2b
