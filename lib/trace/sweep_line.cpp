#include "trace/sweep_line.hpp"

#include <algorithm>

namespace d2b {

SweepLine::SweepLine(std::int32_t levels, std::int32_t first_col, const ElevationRange& range,
                     Outlines outlines)
    : traces_(outlines == Outlines::traced), first_col_(first_col), components_(range) {
    previous_.levels.resize(static_cast<std::size_t>(levels));
    current_.levels.resize(static_cast<std::size_t>(levels));
}

void SweepLine::link(std::int32_t line, const OutsideRows& outside) {
    line_ = line;
    of_points_ = outside.of_points;
    for (std::size_t level = 0; level < current_.levels.size(); ++level)
        link_level(level, outside);
}

/// Finds pairs of runs that share an edge, in order.
void SweepLine::find_links(const Runs& upper, const Runs& lower) {
    links_.clear();
    pinches_.clear();
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    while (i < upper.size() && j < lower.size()) {
        const Run& a = upper[i];
        const Run& b = lower[j];
        if (a.end == b.begin || b.end == a.begin)
            pinches_.push_back(a.end == b.begin ? a.end : b.end);
        else if (a.label == b.label && a.begin < b.end && b.begin < a.end)
            links_.push_back({i, j});
        // Adjacent runs with other labels may start where both end.
        if (a.end == b.end)
            pinches_.push_back(a.end);
        i += a.end <= b.end ? 1U : 0U;
        j += b.end <= a.end ? 1U : 0U;
    }
}

Corner SweepLine::corner(std::int32_t col, double outside) const {
    return {{line_, col + first_col_}, std::binary_search(pinches_.begin(), pinches_.end(), col), outside};
}

/// Lowest elevation of points within a cell of the edge from `from` to `to`.
double SweepLine::lowest(std::span<const double> row, std::int32_t from, std::int32_t to) const {
    if (!with_outside_ || row.empty())
        return nothing_outside;
    const auto begin = static_cast<std::size_t>(std::max(0, from - 1));
    const auto end = std::min(row.size(), static_cast<std::size_t>(to + (of_points_ ? 2 : 1)));
    return *std::min_element(row.begin() + static_cast<std::ptrdiff_t>(begin),
                             row.begin() + static_cast<std::ptrdiff_t>(end));
}

void SweepLine::link_level(std::size_t level, const OutsideRows& outside) {
    Runs& upper = previous_.levels[level];
    Runs& lower = current_.levels[level];
    if (upper.empty() && lower.empty())
        return;
    with_outside_ = level == 1;
    find_links(upper, lower);
    for (std::size_t i = 0; i < links_.size(); ++i)
        follow(i, level, outside);
    // Unlinked runs begin below the line or end above it.
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < upper.size(); ++i) {
        for (; next < links_.size() && links_[next].upper < i;)
            ++next;
        if (next == links_.size() || links_[next].upper != i)
            close_gap(upper[i], upper[i], upper[i].begin, upper[i].end, upper[i].component, outside.below);
    }
    for (Run& run : lower) {
        if (run.component == no_index)
            start(run, level, outside);
        if (with_outside_ && traces_)
            pass_sides(run, outside);
    }
}

/// Unites two runs that share an edge and continues the outlines around them.
void SweepLine::follow(std::size_t i, std::size_t level, const OutsideRows& outside) {
    const Link link = links_[i];
    Runs& uppers = previous_.levels[level];
    Runs& lowers = current_.levels[level];
    Run& upper = uppers[link.upper];
    Run& lower = lowers[link.lower];
    const bool same_lower = i > 0 && links_[i - 1].lower == link.lower;
    const bool same_upper = i > 0 && links_[i - 1].upper == link.upper;
    if (same_lower) {
        // A gap above the lower run ends: join its two sides along the line.
        lower.component = components_.unite(lower.component, upper.component);
        Run& left = uppers[links_[i - 1].upper];
        close_gap(upper, left, upper.begin, left.end, lower.component, outside.above);
    } else {
        lower.component = components_.find(upper.component);
        if (same_upper && traces_) {
            // A gap opens below the upper run.
            Run& left = lowers[links_[i - 1].lower];
            const double beside = lowest(outside.below, left.end, lower.begin);
            const Arms::Pair pair = arms_.open(corner(left.end), corner(lower.begin, beside));
            left.tail = pair.tail;
            lower.head = pair.head;
        } else {
            left_sides_meet(upper, lower, outside);
        }
    }
    components_[lower.component].last_row = line_;
    const bool more =
        i + 1 < links_.size() && (links_[i + 1].lower == link.lower || links_[i + 1].upper == link.upper);
    if (!more)
        right_sides_meet(upper, lower, outside);
}

void SweepLine::left_sides_meet(Run& upper, Run& lower, const OutsideRows& outside) {
    lower.head = upper.head;
    if (!traces_ || lower.begin == upper.begin)
        return;
    const double beside = lower.begin < upper.begin ? lowest(outside.above, lower.begin, upper.begin)
                                                    : lowest(outside.below, upper.begin, lower.begin);
    arms_.extend_head(lower.head, corner(upper.begin), corner(lower.begin, beside));
}

void SweepLine::right_sides_meet(Run& upper, Run& lower, const OutsideRows& outside) {
    lower.tail = upper.tail;
    if (!traces_ || lower.end == upper.end)
        return;
    const double beside = lower.end > upper.end ? lowest(outside.above, upper.end, lower.end)
                                                : lowest(outside.below, lower.end, upper.end);
    arms_.extend_tail(lower.tail, corner(upper.end), corner(lower.end, beside));
}

void SweepLine::start(Run& run, std::size_t level, const OutsideRows& outside) {
    const std::uint32_t below = level == 0 ? no_index : current_.levels[level - 1][run.below].component;
    run.component =
        components_.add(static_cast<std::int32_t>(level), run.label, {line_, run.begin + first_col_}, below);
    if (!traces_)
        return;
    const Arms::Pair pair =
        arms_.open(corner(run.end), corner(run.begin, lowest(outside.above, run.begin, run.end)));
    run.tail = pair.tail;
    run.head = pair.head;
}

/// Joins the head at the left side of `head_run`, column `from`, to the tail at the right side of `tail_run`,
/// column `to`.
void SweepLine::close_gap(Run& head_run, Run& tail_run, std::int32_t from, std::int32_t to,
                          std::uint32_t component, std::span<const double> outside) {
    if (!traces_)
        return;
    const double beside = lowest(outside, std::min(from, to), std::max(from, to));
    const auto ring = arms_.join(head_run.head, corner(from), corner(to, beside), tail_run.tail);
    if (!ring.empty())
        add_outline(components_.find(component), ring);
}

void SweepLine::pass_sides(Run& run, const OutsideRows& outside) {
    // Adjacent columns only, because horizontal edges cover the diagonal neighbours.
    const std::int32_t left = run.begin - 1;
    const std::int32_t right = run.end + (of_points_ ? 1 : 0);
    for (const auto& row : {outside.on, outside.below}) {
        if (left >= 0 && !row.empty())
            arms_.pass(run.head, row[static_cast<std::size_t>(left)]);
        if (static_cast<std::size_t>(right) < row.size())
            arms_.pass(run.tail, row[static_cast<std::size_t>(right)]);
    }
}

}  // namespace d2b
