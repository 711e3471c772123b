#include "raster/regions.hpp"

#include <bit>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.hpp"

namespace d2b {

/// Builds regions from links, row by row. State: the runs so far.
class RegionBuilder {
  public:
    explicit RegionBuilder(std::int32_t cols);
    /// @param links links of the next row; the first row has none upwards
    void add_row(std::span<const std::uint8_t> links);
    /// @param runs runs of the next row, connected by shared edges; their labels are ignored
    void add_touching_row(std::span<const RegionRun> runs);
    /// @param min_cells smaller regions are dropped unless they touch the first or last row
    [[nodiscard]] Regions finish(std::int64_t min_cells) &&;

  private:
    /// Joins the run at `c` with the run above it.
    /// @returns the end column of the latter
    std::int32_t join_above(std::int32_t c, std::size_t& above, Label& label);

    Regions regions_;
    DisjointSets sets_{1};  // of labels; 0 is none
};

namespace {

/// Regions of a band of rows, and the links of its first row to the row above.
struct BandRegions {
    Regions regions;
    std::vector<std::uint8_t> seam;
    Label before = 0;  ///< number of labels in the bands above
};

/// Adds the rows of a band to a builder. The first row gets no links to the row above.
using AddRows = std::function<void(RowBand band, RegionBuilder& builder)>;

/// Drops cells without any connection.
/// @param below links of the next row
void drop_isolated(std::span<std::uint8_t> links, std::span<const std::uint8_t> below) {
    const auto keep = [&](std::size_t c, int right) {
        const int beside = (links[c] & (link_left | link_up)) | (right & link_left) | (below[c] & link_up);
        links[c] = beside != 0 ? links[c] : std::uint8_t{0};
    };
    // A right neighbour that was dropped already had no link. Branch-free, so that the loop vectorises.
    for (std::size_t c = 0; c + 1 < links.size(); ++c)
        keep(c, links[c + 1]);
    if (!links.empty())
        keep(links.size() - 1, 0);
}

void add_linked_rows(RowBand band, std::int32_t rows, bool keep_isolated, const LinksOfRow& links_of,
                     RegionBuilder& builder) {
    std::vector<std::uint8_t> links;
    std::vector<std::uint8_t> below;
    links_of(band.begin, links);
    for (std::int32_t r = band.begin; r < band.end; ++r) {
        if (r + 1 < rows)
            links_of(r + 1, below);
        else
            below.assign(links.size(), 0);
        if (!keep_isolated)
            drop_isolated(links, below);
        if (r == band.begin)
            for (std::uint8_t& link : links)
                link &= link_in | link_left;
        builder.add_row(links);
        links.swap(below);
    }
}

void add_touching_rows(RowBand band, const Mask& mask, std::uint8_t value, RegionBuilder& builder) {
    std::vector<RegionRun> runs;
    for (std::int32_t r = band.begin; r < band.end; ++r) {
        runs.clear();
        for_mask_runs(mask.row(r), value, [&](std::int32_t begin, std::int32_t end) {
            runs.push_back({begin, end, 0});
        });
        builder.add_touching_row(runs);
    }
}

BandRegions label_band(RowBand band, std::int32_t cols, const LinksOfRow& links_of, const AddRows& add_rows,
                       std::int64_t min_cells) {
    BandRegions part;
    links_of(band.begin, part.seam);
    RegionBuilder builder(cols);
    add_rows(band, builder);
    part.regions = std::move(builder).finish(min_cells);
    return part;
}

/// Joins the regions of two adjacent bands across their seam.
void join(const BandRegions& above, const BandRegions& below, DisjointSets& sets) {
    std::span<const RegionRun> upper = above.regions.row(above.regions.rows - 1);
    for (const RegionRun& run : below.regions.row(0))
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            if ((below.seam[static_cast<std::size_t>(c)] & link_up) == 0)
                continue;
            while (upper.front().end <= c)
                upper = upper.subspan(1);
            sets.join(above.before + upper.front().label, below.before + run.label);
        }
}

/// Renumbers the labels of all bands from 1 in scan order; 0 for regions with too few cells.
/// @param cells receives the number of cells per new label
std::vector<Label> renumber_all(std::vector<BandRegions>& parts, std::int64_t min_cells,
                                std::vector<std::int64_t>& cells) {
    DisjointSets sets(1);  // of labels; 0 is none
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].before = i == 0 ? 0 : parts[i - 1].before + parts[i - 1].regions.count();
        for (Label k = 0; k < parts[i].regions.count(); ++k)
            sets.add();
        if (i > 0)
            join(parts[i - 1], parts[i], sets);
    }
    std::vector<Label> number = sets.numbered().of;
    std::vector<std::int64_t> sums(number.size(), 0);
    for (const BandRegions& part : parts)
        for (Label k = 1; k <= part.regions.count(); ++k)
            sums[number[part.before + k]] += part.regions.cells[k];
    std::vector<Label> kept(number.size(), 0);
    cells.assign(1, 0);
    for (std::size_t i = 1; i < sums.size() && sums[i] > 0; ++i)
        if (sums[i] >= min_cells) {
            kept[i] = static_cast<Label>(cells.size());
            cells.push_back(sums[i]);
        }
    for (Label& label : number)
        label = kept[label];
    return number;
}

/// Concatenates the runs of all bands.
void concatenate(std::vector<BandRegions>& parts, Regions& regions, Executor& threads) {
    std::vector<std::size_t> first(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::vector<std::size_t>& rows = parts[i].regions.row_begin;
        first[i] = i == 0 ? 0 : first[i - 1] + parts[i - 1].regions.runs.size();
        for (std::size_t r = 0; r + 1 < rows.size(); ++r)
            regions.row_begin.push_back(first[i] + rows[r]);
    }
    regions.row_begin.push_back(parts.empty() ? 0 : first.back() + parts.back().regions.runs.size());
    regions.runs.resize(regions.row_begin.back());
    threads.for_each(parts.size(), [&](std::size_t i) {
        const std::vector<RegionRun> runs = std::move(parts[i].regions.runs);
        std::copy(runs.begin(), runs.end(), regions.runs.begin() + static_cast<std::ptrdiff_t>(first[i]));
    });
}

/// @param links_of links used to join bands
Regions regions_of(std::int32_t rows, std::int32_t cols, const LinksOfRow& links_of, const AddRows& add_rows,
                   std::int64_t min_cells, Executor& threads) {
    const std::vector<RowBand> bands = row_bands(rows, cols);
    std::vector<BandRegions> parts(bands.size());
    threads.for_each(parts.size(), [&](std::size_t i) {
        parts[i] = label_band(bands[i], cols, links_of, add_rows, min_cells);
    });
    Regions regions;
    regions.rows = rows;
    regions.cols = cols;
    const std::vector<Label> number = renumber_all(parts, min_cells, regions.cells);
    threads.for_each(parts.size(), [&](std::size_t i) {
        relabel(parts[i].regions, std::span(number).subspan(parts[i].before));
    });
    concatenate(parts, regions, threads);
    return regions;
}

constexpr std::uint64_t every_byte = 0x0101010101010101U;

/// Reads eight cells from `c` on as one number, whose lowest byte is the first.
std::uint64_t eight_cells(std::span<const std::uint8_t> links, std::int32_t c) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, links.data() + c, sizeof eight);
    return std::endian::native == std::endian::little ? eight : __builtin_bswap64(eight);
}

/// Returns the first cell from `c` on that belongs to a region, or the end of the row. Tests eight cells at a
/// time, because most rows are mostly empty.
std::int32_t next_in(std::span<const std::uint8_t> links, std::int32_t c) {
    const auto end = static_cast<std::int32_t>(links.size());
    for (; c + 8 <= end; c += 8)
        if (const std::uint64_t eight = eight_cells(links, c); eight != 0)
            return c + std::countr_zero(eight) / 8;
    while (c < end && links[static_cast<std::size_t>(c)] == 0)
        ++c;
    return c;
}

/// Returns the first cell from `c` on at which the run may end or a new run above it may begin. Cells up to
/// `joined_end` were joined to the row above already.
std::int32_t skip_linked(std::span<const std::uint8_t> links, std::int32_t c, std::int32_t joined_end) {
    const auto end = static_cast<std::int32_t>(links.size());
    for (; c + 8 <= end; c += 8) {
        const std::uint64_t eight = eight_cells(links, c);
        const std::int32_t joined = std::max(joined_end - c, 0);
        const std::uint64_t up =
            joined < 8 ? eight & every_byte * link_up & ~std::uint64_t{0} << 8 * joined : 0;
        if (const std::uint64_t stops = (~eight & every_byte * link_left) | up; stops != 0)
            return c + std::countr_zero(stops) / 8;
    }
    return c;
}

/// Finds the overlaps of two sets of runs in a row.
void add_row(std::span<const RegionRun> one, std::span<const RegionRun> other,
             std::vector<RegionOverlap>& found) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < one.size() && j < other.size()) {
        const std::int32_t common =
            std::min(one[i].end, other[j].end) - std::max(one[i].begin, other[j].begin);
        if (common > 0)
            found.push_back({one[i].label, other[j].label, common});
        if (one[i].end < other[j].end)
            ++i;
        else
            ++j;
    }
}

}  // namespace

Regions linked_regions(std::int32_t rows, std::int32_t cols, const LinksOfRow& links_of,
                       std::int64_t min_cells, Executor& threads) {
    const auto add_rows = [&](RowBand band, RegionBuilder& builder) {
        add_linked_rows(band, rows, min_cells <= 1, links_of, builder);
    };
    return regions_of(rows, cols, links_of, add_rows, min_cells, threads);
}

void edge_links(const Mask& mask, std::int32_t r, std::uint8_t value, std::vector<std::uint8_t>& links) {
    links.resize(static_cast<std::size_t>(mask.cols));
    const std::span<const std::uint8_t> here = mask.row(r);
    const std::span<const std::uint8_t> up = mask.row(std::max(r - 1, 0));
    const std::uint8_t other = value ^ 1;
    const std::uint8_t has_up = r > 0 ? 1 : 0;
    static_assert(link_in == 1 && link_left == 2 && link_up == 4);
    // Bytes and shifts only, so that the loop vectorises.
    const auto link = [&](std::size_t c, int left) {
        const int in = here[c] ^ other;
        return static_cast<std::uint8_t>(in | (in & left) << 1 | (in & (up[c] ^ other) & has_up) << 2);
    };
    if (!links.empty())
        links[0] = link(0, 0);
    for (std::size_t c = 1; c < links.size(); ++c)
        links[c] = link(c, here[c - 1] ^ other);
}

Regions connected_regions(const Mask& mask, std::uint8_t value, std::int64_t min_cells, Executor& threads) {
    const auto links_of = [&](std::int32_t r, std::vector<std::uint8_t>& links) {
        edge_links(mask, r, value, links);
    };
    const auto add_rows = [&](RowBand band, RegionBuilder& builder) {
        add_touching_rows(band, mask, value, builder);
    };
    return regions_of(mask.rows, mask.cols, links_of, add_rows, min_cells, threads);
}

std::vector<LabelRange> label_ranges(const Regions& regions) {
    constexpr std::int64_t most = 64;
    std::int64_t all = 0;
    for (const std::int64_t cells : regions.cells)
        all += cells;
    const std::vector<CellBox> boxes = bounding_boxes(regions);
    std::vector<LabelRange> ranges;
    std::int64_t cells = 0;
    for (Label label = 1; label < boxes.size(); ++label) {
        if (ranges.empty() || cells > all / most) {
            ranges.push_back({label, label, {boxes[label].first_row, 0}});
            cells = 0;
        }
        LabelRange& range = ranges.back();
        range.end = label + 1;
        range.rows.end = std::max(range.rows.end, boxes[label].end_row);
        cells += regions.cells[label];
    }
    return ranges;
}

const RegionRun* run_at(std::span<const RegionRun> row, std::int32_t col) {
    const auto run =
        std::ranges::partition_point(row, [&](const RegionRun& before) { return before.end <= col; });
    return run != row.end() && run->begin <= col ? &*run : nullptr;
}

std::vector<CellBox> bounding_boxes(const Regions& regions) {
    std::vector<CellBox> boxes(regions.cells.size());
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            CellBox& box = boxes[run.label];
            box = {std::min(box.first_row, r), r + 1, std::min(box.first_col, run.begin),
                   std::max(box.end_col, run.end)};
        }
    return boxes;
}

Grid<Label> label_grid(const Regions& regions, std::span<const Label> number, Executor& threads) {
    Grid<Label> result(regions.rows, regions.cols, 0, threads);
    for_rows(threads, regions.rows, regions.cols, [&](std::int32_t r) {
        for (const RegionRun& run : regions.row(r))
            std::fill(result.row(r).begin() + run.begin, result.row(r).begin() + run.end, number[run.label]);
    });
    return result;
}

RegionBuilder::RegionBuilder(std::int32_t cols) {
    regions_.cols = cols;
    regions_.row_begin.push_back(0);
}

std::int32_t RegionBuilder::join_above(std::int32_t c, std::size_t& above, Label& label) {
    while (regions_.runs[above].end <= c)
        ++above;
    const RegionRun& upper = regions_.runs[above];
    if (label == 0)
        label = upper.label;
    else if (label != upper.label)
        label = sets_.join(label, upper.label);
    return upper.end;
}

void RegionBuilder::add_row(std::span<const std::uint8_t> links) {
    // Index of the first run of the row above. The first row has no links upwards.
    std::size_t above = regions_.rows > 0 ? regions_.row_begin[regions_.row_begin.size() - 2] : 0;
    for (std::int32_t c = next_in(links, 0); c < regions_.cols; c = next_in(links, c)) {
        RegionRun run{c, c, 0};
        std::int32_t joined_end = 0;
        do {
            if ((links[static_cast<std::size_t>(c)] & link_up) != 0 && c >= joined_end)
                joined_end = join_above(c, above, run.label);
            c = skip_linked(links, c + 1, joined_end);
        } while (c < regions_.cols && (links[static_cast<std::size_t>(c)] & link_left) != 0);
        run.end = c;
        if (run.label == 0)
            run.label = sets_.add();
        regions_.runs.push_back(run);
    }
    regions_.row_begin.push_back(regions_.runs.size());
    ++regions_.rows;
}

void RegionBuilder::add_touching_row(std::span<const RegionRun> runs) {
    std::size_t above = regions_.rows > 0 ? regions_.row_begin[regions_.row_begin.size() - 2] : 0;
    const std::size_t above_end = regions_.row_begin.back();
    for (RegionRun run : runs) {
        run.label = 0;
        while (above < above_end && regions_.runs[above].end <= run.begin)
            ++above;
        // The last of these runs may overlap the next run as well.
        for (std::size_t k = above; k < above_end && regions_.runs[k].begin < run.end; ++k) {
            const Label label = regions_.runs[k].label;
            if (run.label == 0)
                run.label = label;
            else if (run.label != label)
                run.label = sets_.join(run.label, label);
        }
        if (run.label == 0)
            run.label = sets_.add();
        regions_.runs.push_back(run);
    }
    regions_.row_begin.push_back(regions_.runs.size());
    ++regions_.rows;
}

Regions RegionBuilder::finish(std::int64_t min_cells) && {
    auto [number, count] = sets_.numbered();
    std::vector<std::int64_t> cells(count, 0);
    for (const RegionRun& run : regions_.runs)
        cells[number[run.label]] += run.end - run.begin;
    std::vector<bool> keep(cells.size(), min_cells <= 1);
    for (const std::int32_t r : {0, regions_.rows - 1})
        if (regions_.rows > 0)
            for (const RegionRun& run : regions_.row(r))
                keep[number[run.label]] = true;
    std::vector<Label> kept(cells.size(), 0);
    regions_.cells.assign(1, 0);
    for (std::size_t i = 1; i < cells.size(); ++i)
        if (keep[i] || cells[i] >= min_cells) {
            kept[i] = static_cast<Label>(regions_.cells.size());
            regions_.cells.push_back(cells[i]);
        }
    for (Label& label : number)
        label = kept[label];
    relabel(regions_, number);
    return std::move(regions_);
}

void relabel(Regions& regions, std::span<const Label> number) {
    std::size_t kept = 0;
    std::size_t i = 0;
    for (std::size_t r = 0; r + 1 < regions.row_begin.size(); ++r) {
        regions.row_begin[r] = kept;
        // row_begin of the next row still refers to the old runs.
        for (; i < regions.row_begin[r + 1]; ++i) {
            RegionRun run = regions.runs[i];
            run.label = number[run.label];
            if (run.label != 0)
                regions.runs[kept++] = run;
        }
    }
    regions.row_begin.back() = kept;
    regions.runs.resize(kept);
}

std::vector<RegionOverlap> region_overlaps(const Regions& one, const Regions& other) {
    std::vector<RegionOverlap> found;
    for (std::int32_t r = 0; r < one.rows; ++r)
        add_row(one.row(r), other.row(r), found);
    std::ranges::sort(found, {}, [](const RegionOverlap& o) { return std::tuple(o.one, o.other); });
    std::size_t kept = 0;
    for (const RegionOverlap& overlap : found)
        if (kept > 0 && found[kept - 1].one == overlap.one && found[kept - 1].other == overlap.other)
            found[kept - 1].cells += overlap.cells;
        else
            found[kept++] = overlap;
    found.resize(kept);
    return found;
}

std::vector<Label> containing_regions(const Regions& one, const Regions& other) {
    std::vector<Label> parent(one.cells.size(), 0);
    std::vector<std::int64_t> most(one.cells.size(), 0);
    for (const RegionOverlap& overlap : region_overlaps(one, other))
        if (overlap.cells > most[overlap.one]) {
            most[overlap.one] = overlap.cells;
            parent[overlap.one] = overlap.other;
        }
    return parent;
}

}  // namespace d2b
