#include "detect/regions.hpp"

#include <algorithm>
#include <cstring>

namespace d2b {
namespace {

constexpr std::uint64_t every_byte = 0x0101010101010101U;

/// The first cell from `c` on that belongs to a region, or the row's end. Most rows are mostly empty.
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

/// The first cell from `c` on at which a run may end or another one above it begin. What is joined above it
/// up to `joined_end` need not be looked at.
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

/// Gives runs their numbers, takes those out that get 0, and counts cells.
void renumber(Regions& regions, const std::vector<Label>& number) {
    const Label last = number.empty() ? 0 : *std::max_element(number.begin(), number.end());
    regions.cells.assign(last + std::size_t{1}, 0);
    std::size_t kept = 0;
    std::size_t i = 0;
    for (std::size_t r = 0; r + 1 < regions.row_begin.size(); ++r) {
        regions.row_begin[r] = kept;
        // The next row's begin is still that of the runs before.
        for (; i < regions.row_begin[r + 1]; ++i) {
            RegionRun run = regions.runs[i];
            run.label = number[run.label];
            if (run.label == 0)
                continue;
            regions.cells[run.label] += run.end - run.begin;
            regions.runs[kept++] = run;
        }
    }
    regions.row_begin.back() = kept;
    regions.runs.resize(kept);
    regions.runs.shrink_to_fit();
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
    // Of the row above; the first row has no links to it.
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

Regions RegionBuilder::finish() && {
    renumber(regions_, sets_.numbered());
    return std::move(regions_);
}

void edge_links(const Mask& mask, std::int32_t r, std::uint8_t value, std::vector<std::uint8_t>& links) {
    links.resize(static_cast<std::size_t>(mask.cols));
    const std::span<const std::uint8_t> here = mask.row(r);
    const std::span<const std::uint8_t> up = mask.row(std::max(r - 1, 0));
    const int other = value ^ 1;
    const int has_up = r > 0 ? link_up : 0;
    const auto link = [&](std::size_t c, int left) {
        const int in = here[c] ^ other;
        return static_cast<std::uint8_t>(in * (link_in + left * link_left + (up[c] ^ other) * has_up));
    };
    if (!links.empty())
        links[0] = link(0, 0);
    for (std::size_t c = 1; c < links.size(); ++c)
        links[c] = link(c, here[c - 1] ^ other);
}

Regions connected_regions(const Mask& mask, std::uint8_t value) {
    RegionBuilder builder(mask.cols);
    std::vector<std::uint8_t> links;
    for (std::int32_t r = 0; r < mask.rows; ++r) {
        edge_links(mask, r, value, links);
        builder.add_row(links);
    }
    return std::move(builder).finish();
}

void drop_small(Regions& regions, std::int64_t least_cells) {
    std::vector<Label> number(regions.cells.size(), 0);
    Label next = 0;
    for (std::size_t i = 1; i < number.size(); ++i)
        if (regions.cells[i] >= least_cells)
            number[i] = ++next;
    renumber(regions, number);
}

Mask mask_of(const Regions& regions) {
    Mask result(regions.rows, regions.cols);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            std::memset(result.row(r).data() + run.begin, 1, static_cast<std::size_t>(run.end - run.begin));
    return result;
}

Grid<Label> label_grid(const Regions& regions, std::span<const Label> number) {
    Grid<Label> result(regions.rows, regions.cols);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            std::fill(result.row(r).begin() + run.begin, result.row(r).begin() + run.end, number[run.label]);
    return result;
}

}  // namespace d2b
