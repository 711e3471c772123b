#include "detect/region_builder.hpp"

#include <algorithm>
#include <cstring>

namespace d2b {
namespace {

constexpr std::uint64_t every_byte = 0x0101010101010101U;

/// Returns the first cell from `c` on that belongs to a region, or the end of the row. Tests eight cells at a
/// time, because most rows are mostly empty.
std::int32_t next_in(std::span<const std::uint8_t> links, std::int32_t c) {
    const auto end = static_cast<std::int32_t>(links.size());
    for (std::uint64_t eight = 0; c + 8 <= end; c += 8) {
        std::memcpy(&eight, links.data() + c, sizeof eight);
        if (eight != 0)
            break;
    }
    while (c < end && links[static_cast<std::size_t>(c)] == 0)
        ++c;
    return c;
}

/// Returns the first cell from `c` on at which the run may end or a new run above it may begin. Cells up to
/// `joined_end` were joined to the row above already.
std::int32_t skip_linked(std::span<const std::uint8_t> links, std::int32_t c, std::int32_t joined_end) {
    const auto end = static_cast<std::int32_t>(links.size());
    for (std::uint64_t eight = 0; c + 8 <= end; c += 8) {
        std::memcpy(&eight, links.data() + c, sizeof eight);
        const bool left = (~eight & every_byte * link_left) == 0;
        const bool up = (eight & every_byte * link_up) != 0;
        if (!left || (up && c + 8 > joined_end))
            break;
    }
    return c;
}

}  // namespace

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

Regions RegionBuilder::finish(std::int64_t least_cells) && {
    std::vector<Label> number = sets_.numbered();
    const Label count = *std::max_element(number.begin(), number.end());
    std::vector<std::int64_t> cells(count + std::size_t{1}, 0);
    for (const RegionRun& run : regions_.runs)
        cells[number[run.label]] += run.end - run.begin;
    std::vector<bool> keep(cells.size(), least_cells <= 1);
    for (const std::int32_t r : {0, regions_.rows - 1})
        if (regions_.rows > 0)
            for (const RegionRun& run : regions_.row(r))
                keep[number[run.label]] = true;
    std::vector<Label> kept(cells.size(), 0);
    regions_.cells.assign(1, 0);
    for (std::size_t i = 1; i < cells.size(); ++i)
        if (keep[i] || cells[i] >= least_cells) {
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

}  // namespace d2b
