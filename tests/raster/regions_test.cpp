#include "raster/regions.hpp"

#include <atomic>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/disjoint_sets.hpp"
#include "raster/morphology.hpp"
#include "support/masks.hpp"
#include "support/test_threads.hpp"

namespace d2b::test {
namespace {

std::vector<Label> labels_of(const Regions& regions) {
    std::vector<Label> itself(regions.cells.size());
    std::iota(itself.begin(), itself.end(), Label{0});
    const Grid<Label> labels = label_grid(regions, itself, threads());
    return {labels.values.begin(), labels.values.end()};
}

/// Floods one region after the other, in scan order of their first cells. Those with fewer cells have no
/// label.
template <typename Joined>
std::vector<Label> flooded(const Mask& in, std::uint8_t value, const Joined& joined, std::size_t least = 0) {
    std::vector<Label> labels(in.size(), 0);
    std::vector<bool> seen(in.size(), false);
    Label last = 0;
    for (std::size_t first = 0; first < in.size(); ++first) {
        if (in.values[first] != value || seen[first])
            continue;
        std::vector<std::size_t> region{first};
        seen[first] = true;
        for (std::size_t k = 0; k < region.size(); ++k) {
            const std::size_t i = region[k];
            const auto r = static_cast<std::int32_t>(i / static_cast<std::size_t>(in.cols));
            const auto c = static_cast<std::int32_t>(i % static_cast<std::size_t>(in.cols));
            for (const auto& [y, x] : {std::pair{r - 1, c}, {r + 1, c}, {r, c - 1}, {r, c + 1}}) {
                if (!in.holds(y, x))
                    continue;
                const std::size_t j = in.index(y, x);
                if (in.values[j] == value && !seen[j] && joined(std::min(i, j), std::max(i, j))) {
                    seen[j] = true;
                    region.push_back(j);
                }
            }
        }
        if (region.size() < least)
            continue;
        ++last;
        for (const std::size_t i : region)
            labels[i] = last;
    }
    return labels;
}

bool always(std::size_t, std::size_t) {
    return true;
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
        const Mask mask =
            i % 2 == 0 ? random_mask(rows, cols, 30 + i % 70, random) : random_blocks(rows, cols, 30, random);
        for (const std::uint8_t value : {std::uint8_t{1}, std::uint8_t{0}}) {
            const Regions regions = connected_regions(mask, value, 0, threads());
            const auto expected = flooded(mask, value, always);
            ASSERT_EQ(labels_of(regions), expected) << i;
            expect_counts(regions, expected);
        }
        ASSERT_EQ(drawing(mask_of(connected_regions(mask, 1, 0, threads()), threads())), drawing(mask)) << i;
    }
}

TEST(Regions, JoinedLikeAFlood) {
    std::mt19937 random(2);
    for (unsigned i = 0; i < 400; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 20);
        const auto cols = static_cast<std::int32_t>(1 + random() % 50);
        const Mask mask = random_mask(rows, cols, 50 + i % 51, random);
        std::vector<int> height(mask.size());
        for (int& h : height)
            h = static_cast<int>(random() % (2 + i % 5));
        const auto joined = [&](std::size_t a, std::size_t b) { return std::abs(height[a] - height[b]) < 2; };
        const Regions regions = joined_regions(mask, joined, threads());
        const auto expected = flooded(mask, 1, joined);
        ASSERT_EQ(labels_of(regions), expected) << i;
        expect_counts(regions, expected);
    }
}

TEST(Regions, RunsLieInScanOrderAndDoNotTouchWithinARegion) {
    const Regions regions = connected_regions(drawn({"##.#", "....", "####"}), 1, 0, threads());
    ASSERT_EQ(regions.count(), 3U);
    ASSERT_EQ(regions.row(0).size(), 2U);
    EXPECT_EQ(regions.row(0)[1].begin, 3);
    EXPECT_EQ(regions.row(0)[1].end, 4);
    EXPECT_EQ(regions.row(0)[1].label, 2U);
    EXPECT_TRUE(regions.row(1).empty());
    EXPECT_EQ(regions.row(2)[0].end, 4);
    EXPECT_EQ(connected_regions(Mask(), 1, 0, threads()).count(), 0U);
}

TEST(Regions, BandsAndThreadsDoNotShow) {
    std::mt19937 random(3);
    Mask mask(90, 20000);  // bands of sixteen rows
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = random() % 100 < (i % 20000 < 9000 ? 57 : 62) ? 1 : 0;
    for (const std::int64_t least : {0, 40}) {
        const auto expected = flooded(mask, 1, always, static_cast<std::size_t>(least));
        for (const int count : {1, 2, 5}) {
            Executor threads(count);
            const Regions regions = connected_regions(mask, 1, least, threads);
            ASSERT_TRUE(labels_of(regions) == expected) << count << " threads, at least " << least;
            expect_counts(regions, expected);
        }
    }
}

TEST(Regions, RunsOfALabelComeInScanOrder) {
    std::mt19937 random(4);
    Mask mask(60, 30000);
    for (std::uint8_t& value : mask.values)
        value = random() % 10 < 6 ? 1 : 0;
    const Regions regions = connected_regions(mask, 1, 0, threads());
    std::vector<std::pair<std::int32_t, std::int32_t>> last(regions.cells.size(), {-1, -1});
    std::vector<std::int64_t> cells(regions.cells.size(), 0);
    std::atomic<bool> ordered = true;
    for_runs_by_label(threads(), regions, [&](std::int32_t row, const RegionRun& run) {
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
    const Regions regions = connected_regions(drawn({"#.#"}), 1, 0, threads());
    EXPECT_EQ(label_grid(regions, std::vector<Label>{0, 7, 0}, threads()).values,
              (std::vector<Label>{7, 0, 0}));
}

TEST(DisjointSets, SmallestStandsForAll) {
    DisjointSets sets(1);
    for (Label label = 1; label <= 5; ++label)
        EXPECT_EQ(sets.add(), label);
    EXPECT_EQ(sets.join(5, 4), 4U);
    EXPECT_EQ(sets.join(5, 2), 2U);
    EXPECT_EQ(sets.find(4), 2U);
    EXPECT_EQ(sets.join(4, 5), 2U);
    EXPECT_EQ(sets.numbered().of, (std::vector<Label>{0, 1, 2, 3, 2, 2}));
}

TEST(Holes, SmallOnesAreFilled) {
    Mask mask = drawn({"#########",  //
                       "#.##..###",  //
                       "####.####",  //
                       "#########"});
    fill_small_holes(mask, 3, threads());
    EXPECT_EQ(drawing(mask), drawing(drawn({"#########",  //
                                            "####..###",  //
                                            "####.####",  //
                                            "#########"})))
        << "three cells are not fewer than three";
    fill_small_holes(mask, 4, threads());
    EXPECT_EQ(drawing(mask), drawing(Mask(4, 9, 1)));
}

TEST(Holes, ThoseAtTheBorderStay) {
    const Mask mask = drawn({"##.##",  //
                             "#####",  //
                             ".###.",  //
                             "#####",  //
                             "##.##"});
    Mask filled = mask;
    fill_small_holes(filled, 100, threads());
    EXPECT_EQ(drawing(filled), drawing(mask));
}

TEST(Holes, DiagonalIsNoWayOut) {
    Mask mask = drawn({"..###",  //
                       "..#.#",  //
                       "###.#",  //
                       "#.###",  //
                       "#####"});
    fill_small_holes(mask, 3, threads());
    EXPECT_EQ(drawing(mask), drawing(drawn({"..###", "..###", "#####", "#####", "#####"})));
}

Regions regions_of(const std::vector<std::string>& rows) {
    return connected_regions(drawn(rows), 1, 0, threads());
}

TEST(RegionOverlaps, CountsTheCellsOfEachPair) {
    const Regions one = regions_of({"##..###", "##..###", ".......", "####..."});
    const Regions other = regions_of({".######", "..#...#", "#......", "#.##..."});
    using Overlaps = std::vector<RegionOverlap>;
    EXPECT_EQ(region_overlaps(one, other), (Overlaps{{1, 1, 1}, {2, 1, 4}, {3, 2, 1}, {3, 3, 2}}));
    EXPECT_EQ(region_overlaps(other, one), (Overlaps{{1, 1, 1}, {1, 2, 4}, {2, 3, 1}, {3, 3, 2}}));
}

TEST(RegionOverlaps, HolderIsTheOneWithMostCells) {
    const Regions one = regions_of({"#####", ".....", "####.", ".....", "#...."});
    const Regions other = regions_of({"##.##", "...#.", "##.##", ".....", "....#"});
    // The first of two with as many cells; the last region is in none.
    EXPECT_EQ(containing_regions(one, other), (std::vector<Label>{0, 1, 3, 0}));
}

TEST(RegionOverlaps, OfNothingThereAreNone) {
    const Regions none = regions_of({"...", "..."});
    const Regions some = regions_of({"##.", "..."});
    EXPECT_TRUE(region_overlaps(none, some).empty());
    EXPECT_EQ(containing_regions(some, none), (std::vector<Label>{0, 0}));
}

using Runs = std::vector<std::pair<std::int32_t, std::int32_t>>;

Runs runs_of(const std::vector<std::uint8_t>& row, std::uint8_t value) {
    Runs runs;
    for_mask_runs(row, value, [&](std::int32_t begin, std::int32_t end) { runs.emplace_back(begin, end); });
    return runs;
}

Runs runs_by_cell(const std::vector<std::uint8_t>& row, std::uint8_t value) {
    Runs runs;
    for (std::int32_t c = 0; c < static_cast<std::int32_t>(row.size()); ++c) {
        if (row[static_cast<std::size_t>(c)] != value)
            continue;
        if (runs.empty() || runs.back().second != c)
            runs.emplace_back(c, c);
        runs.back().second = c + 1;
    }
    return runs;
}

TEST(MaskRuns, EndWithTheRow) {
    EXPECT_EQ(runs_of({}, 1), Runs());
    EXPECT_EQ(runs_of({1}, 1), (Runs{{0, 1}}));
    EXPECT_EQ(runs_of({1}, 0), Runs());
    for (const std::int32_t cols : {63, 64, 65, 128, 200}) {
        const std::vector<std::uint8_t> row(static_cast<std::size_t>(cols), 1);
        EXPECT_EQ(runs_of(row, 1), (Runs{{0, cols}}));
        EXPECT_EQ(runs_of(row, 0), Runs());
    }
}

TEST(MaskRuns, AreThoseOfCellAfterCell) {
    std::mt19937 random(11);  // NOLINT: the same rows in every run
    for (const std::size_t cols : {1U, 7U, 8U, 9U, 63U, 64U, 65U, 127U, 128U, 129U, 1000U})
        for (const double share : {0.02, 0.5, 0.98}) {
            std::bernoulli_distribution is(share);
            std::vector<std::uint8_t> row(cols);
            for (std::uint8_t& cell : row)
                cell = is(random) ? 1 : 0;
            for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{1}})
                EXPECT_EQ(runs_of(row, value), runs_by_cell(row, value)) << cols << " " << share;
        }
}

}  // namespace
}  // namespace d2b::test
