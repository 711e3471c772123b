#include "contours/sweep_line.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace d2b::contours {

/// Splits a closed outline into simple rings. Because squares are joined along edges only, an outline
/// touches itself if two squares of one contour share just a corner:
///
///     # # .        the outline of the # goes around the inner dot through the corner; split there, the
///     # . #  <-    outer ring and the hole each pass it once, and the hole touches the outer ring,
///     # # #        which is valid
///
/// Loops of a planar outline nest like brackets, so one pass with a stack finds them in linear time.
/// @return at least one ring, each with at least four corners
[[nodiscard]] std::vector<std::vector<Corner>> split_at_non_manifold_vertices(
    std::span<const Corner> outline);

std::vector<std::vector<Corner>> split_at_non_manifold_vertices(std::span<const Corner> outline) {
    std::vector<std::vector<Corner>> rings;
    std::vector<Corner> path;
    std::map<LatticePoint, std::size_t> passed;  // non-manifold vertices on the path and their indices
    for (const Corner& corner : outline) {
        if (corner.non_manifold) {
            const auto [place, is_new] = passed.try_emplace(corner.at, path.size());
            if (!is_new) {
                const auto loop = path.begin() + static_cast<std::ptrdiff_t>(place->second);
                rings.emplace_back(loop, path.end());
                // The last edge of the loop leads here on the second visit.
                rings.back().front().outside = corner.outside;
                for (auto dropped = loop + 1; dropped != path.end(); ++dropped)
                    if (dropped->non_manifold)
                        passed.erase(dropped->at);
                path.erase(loop + 1, path.end());
                continue;
            }
        }
        path.push_back(corner);
    }
    rings.push_back(std::move(path));
    return rings;
}

SweepLine::SweepLine(std::int32_t levels, std::int32_t first_col, const ElevationRange& range)
    : first_col_(first_col), components_(range) {
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
    non_manifold_cols_.clear();
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    while (i < upper.size() && j < lower.size()) {
        const Run& a = upper[i];
        const Run& b = lower[j];
        if (a.end == b.begin || b.end == a.begin)
            non_manifold_cols_.push_back(a.end == b.begin ? a.end : b.end);
        else if (a.label == b.label && a.begin < b.end && b.begin < a.end)
            links_.push_back({i, j});
        // Adjacent runs with other labels may start where both end.
        if (a.end == b.end)
            non_manifold_cols_.push_back(a.end);
        i += a.end <= b.end ? 1U : 0U;
        j += b.end <= a.end ? 1U : 0U;
    }
}

Corner SweepLine::corner(std::int32_t col, double outside) const {
    return {{line_, col + first_col_},
            std::binary_search(non_manifold_cols_.begin(), non_manifold_cols_.end(), col),
            outside};
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
        link_runs(i, level, outside);
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
        if (with_outside_)
            add_side_outside(run, outside);
    }
}

/// Unites two runs that share an edge and continues the outlines around them.
void SweepLine::link_runs(std::size_t i, std::size_t level, const OutsideRows& outside) {
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
        if (same_upper) {
            // A gap opens below the upper run.
            Run& left = lowers[links_[i - 1].lower];
            const double beside = lowest(outside.below, left.end, lower.begin);
            const OpenChains::Pair pair = chains_.open(corner(left.end), corner(lower.begin, beside));
            left.tail = pair.tail;
            lower.head = pair.head;
        } else {
            join_left_sides(upper, lower, outside);
        }
    }
    components_[lower.component].last_row = line_;
    const bool more =
        i + 1 < links_.size() && (links_[i + 1].lower == link.lower || links_[i + 1].upper == link.upper);
    if (!more)
        join_right_sides(upper, lower, outside);
}

void SweepLine::join_left_sides(Run& upper, Run& lower, const OutsideRows& outside) {
    lower.head = upper.head;
    if (lower.begin == upper.begin)
        return;
    const double beside = lower.begin < upper.begin ? lowest(outside.above, lower.begin, upper.begin)
                                                    : lowest(outside.below, upper.begin, lower.begin);
    chains_.extend_head(lower.head, corner(upper.begin), corner(lower.begin, beside));
}

void SweepLine::join_right_sides(Run& upper, Run& lower, const OutsideRows& outside) {
    lower.tail = upper.tail;
    if (lower.end == upper.end)
        return;
    const double beside = lower.end > upper.end ? lowest(outside.above, upper.end, lower.end)
                                                : lowest(outside.below, lower.end, upper.end);
    chains_.extend_tail(lower.tail, corner(upper.end), corner(lower.end, beside));
}

void SweepLine::start(Run& run, std::size_t level, const OutsideRows& outside) {
    const std::uint32_t below = level == 0 ? no_index : current_.levels[level - 1][run.below].component;
    run.component =
        components_.add(static_cast<std::int32_t>(level), run.label, {line_, run.begin + first_col_}, below);
    const OpenChains::Pair pair =
        chains_.open(corner(run.end), corner(run.begin, lowest(outside.above, run.begin, run.end)));
    run.tail = pair.tail;
    run.head = pair.head;
}

/// Joins the head at the left side of `head_run`, column `from`, to the tail at the right side of `tail_run`,
/// column `to`.
void SweepLine::close_gap(Run& head_run, Run& tail_run, std::int32_t from, std::int32_t to,
                          std::uint32_t component, std::span<const double> outside) {
    const double beside = lowest(outside, std::min(from, to), std::max(from, to));
    const auto ring = chains_.join(head_run.head, corner(from), corner(to, beside), tail_run.tail);
    if (!ring.empty())
        add_outline(components_.find(component), ring);
}

void SweepLine::add_side_outside(Run& run, const OutsideRows& outside) {
    // Adjacent columns only, because horizontal edges cover the diagonal neighbours.
    const std::int32_t left = run.begin - 1;
    const std::int32_t right = run.end + (of_points_ ? 1 : 0);
    for (const auto& row : {outside.on, outside.below}) {
        if (left >= 0 && !row.empty())
            chains_.add_outside(run.head, row[static_cast<std::size_t>(left)]);
        if (static_cast<std::size_t>(right) < row.size())
            chains_.add_outside(run.tail, row[static_cast<std::size_t>(right)]);
    }
}

void SweepLine::begin_band(std::int32_t line, const RunRow& squares) {
    line_ = line;
    previous_ = top_ = squares;
    for (std::size_t level = 0; level < top_.levels.size(); ++level)
        for (std::size_t i = 0; i < top_.levels[level].size(); ++i) {
            Run& top = top_.levels[level][i];
            const std::uint32_t below = level == 0 ? no_index : top_.levels[level - 1][top.below].component;
            top.component = components_.add(static_cast<std::int32_t>(level), top.label,
                                            {line_, top.begin + first_col_}, below);
            components_[top.component].open_above = true;
            const OpenChains::Sides sides =
                chains_.open_above({line_, top.begin + first_col_}, {line_, top.end + first_col_});
            top.head = sides.above.tail;
            top.tail = sides.above.head;
            Run& run = previous_.levels[level][i];
            run.component = top.component;
            run.head = sides.below.head;
            run.tail = sides.below.tail;
        }
}

/// Adds the components of a row to the list of the band, low levels first.
void SweepLine::list_components(OpenBand& band, RunRow& row) {
    for (std::vector<Run>& runs : row.levels)
        for (Run& run : runs) {
            const std::uint32_t root = components_.find(run.component);
            Component& c = components_[root];
            std::uint32_t place = c.place;
            if (place == no_index) {
                place = c.place = static_cast<std::uint32_t>(band.components.size());
                // Moved-from components keep their numbers.
                Component& placed = band.components.emplace_back(std::move(c));
                if (placed.level > 0)
                    placed.below = components_[components_.find(placed.below)].place;
            }
            run.component = place;
        }
}

/// @param tail beginning of the piece @param at_top true for chain ends in the first row of the band
std::uint32_t SweepLine::add_piece(std::uint32_t tail, const std::vector<bool>& at_top,
                                   OpenBand& band) const {
    OutlinePiece piece{band.corners.size()};
    const std::uint32_t head = chains_.copy_chain(tail, band.corners);
    piece.outside_begin = chains_.outside(tail);
    piece.outside_end = chains_.outside(head);
    // Chains have a placeholder corner in the first row of the band.
    if (at_top[head]) {
        piece.outside_end = band.corners.back().outside;
        band.corners.pop_back();
    }
    if (at_top[tail])
        band.corners.erase(band.corners.begin() + static_cast<std::ptrdiff_t>(piece.first));
    piece.corners = band.corners.size() - piece.first;
    if (at_top[tail] && piece.corners > 0)
        piece.outside_begin = band.corners[piece.first].outside;
    if (piece.corners == 0)
        piece.outside_begin = piece.outside_end = std::min(piece.outside_begin, piece.outside_end);
    band.pieces.push_back(piece);
    return head;
}

OpenBand SweepLine::take_open() {
    OpenBand band;
    band.top = std::exchange(top_, {});
    band.bottom = std::exchange(previous_, {});
    band.last_line = line_;
    list_components(band, band.top);
    list_components(band, band.bottom);
    std::vector<bool> at_top(chains_.end());
    for (const std::vector<Run>& runs : band.top.levels)
        for (const Run& run : runs)
            at_top[run.head] = at_top[run.tail] = true;
    // Piece per chain end at its end.
    std::vector<std::uint32_t> piece_to(chains_.end(), no_index);
    const auto add = [&](std::uint32_t& tail) {
        const auto piece = static_cast<std::uint32_t>(band.pieces.size());
        piece_to[add_piece(tail, at_top, band)] = piece;
        tail = piece;
    };
    for (std::vector<Run>& runs : band.top.levels)
        for (Run& run : runs)
            add(run.head);
    for (std::vector<Run>& runs : band.bottom.levels)
        for (Run& run : runs)
            add(run.tail);
    for (std::vector<Run>& runs : band.top.levels)
        for (Run& run : runs)
            run.tail = piece_to[run.tail];
    for (std::vector<Run>& runs : band.bottom.levels)
        for (Run& run : runs)
            run.head = piece_to[run.head];
    return band;
}

void SweepLine::join(OpenBand& band, std::int64_t first_name) {
    std::vector<std::uint32_t> components;
    components.reserve(band.components.size());
    for (Component& found : band.components) {
        found.open_above = false;
        found.place = no_index;
        if (found.level > 0)
            found.below = components[found.below];
        for (std::int64_t& name : found.children)
            name += first_name;
        components.push_back(components_.add(std::move(found)));
    }
    std::vector<OpenChains::Pair> chains;
    chains.reserve(band.pieces.size());
    for (const OutlinePiece& piece : band.pieces)
        chains.push_back(piece.corners == 0
                             ? OpenChains::Pair{no_index, no_index}
                             : chains_.add(std::span(band.corners).subspan(piece.first, piece.corners),
                                           piece.outside_begin, piece.outside_end));
    const auto for_top_runs = [&](const auto& work) {
        for (std::size_t level = 0; level < current_.levels.size(); ++level)
            for (std::size_t i = 0; i < current_.levels[level].size(); ++i)
                work(current_.levels[level][i], band.top.levels[level][i]);
    };
    for_top_runs([&](Run& run, const Run& top) {
        run.component = components_.unite(run.component, components[top.component]);
    });
    // Close rings after uniting, because a ring may be the exterior of the united component.
    const auto close = [&](const Run& run, std::span<const Corner> ring) {
        if (!ring.empty())
            add_outline(components_.find(run.component), ring);
    };
    for_top_runs([&](Run& run, const Run& top) {
        OpenChains::Pair& down = chains[top.head];
        if (down.tail == no_index) {
            chains_.add_outside(run.head, band.pieces[top.head].outside_end);
            down.head = run.head;
        } else {
            close(run, chains_.connect(run.head, down.tail));
        }
        OpenChains::Pair& up = chains[top.tail];
        if (up.head == no_index) {
            chains_.add_outside(run.tail, band.pieces[top.tail].outside_begin);
            up.tail = run.tail;
        } else {
            close(run, chains_.connect(up.head, run.tail));
        }
    });
    for (std::vector<Run>& runs : band.bottom.levels)
        for (Run& run : runs) {
            run.component = components_.find(components[run.component]);
            run.head = chains[run.head].head;
            run.tail = chains[run.tail].tail;
        }
}

void SweepLine::add_outline(std::uint32_t component, std::span<const Corner> outline) {
    Component& c = components_[component];
    if (std::ranges::none_of(outline, &Corner::non_manifold)) {
        add_ring(c, outline);
        return;
    }
    for (const std::vector<Corner>& corners : split_at_non_manifold_vertices(outline))
        add_ring(c, corners);
}

void SweepLine::add_ring(Component& c, std::span<const Corner> corners) {
    ring_.clear();
    for (const Corner& corner : corners)
        ring_.push_back(corner.at);
    PackedRing packed(ring_);
    if (packed.area() < 0) {
        c.interiors.push_back(std::move(packed));
        return;
    }
    c.exterior = std::move(packed);
    for (const Corner& corner : corners)
        c.lowest_outside = std::min(c.lowest_outside, corner.outside);
}

void SweepLine::finish_row(std::vector<Run>& runs, std::int32_t line, ContourSink& sink) {
    for (const Run& run : runs) {
        const std::uint32_t root = components_.find(run.component);
        Component& c = components_[root];
        // Negative last rows mark contours already handed out, because several runs of the row above may
        // belong to one contour.
        if (c.last_row >= 0 && c.last_row < line && !c.open_above)
            finish(root, sink);
    }
}

void SweepLine::finish_ended(ContourSink& sink) {
    for (auto level = previous_.levels.rbegin(); level != previous_.levels.rend(); ++level)
        finish_row(*level, line_, sink);
    std::swap(previous_, current_);
    current_.clear();
}

void SweepLine::finish_band(OpenBand&& band, ContourSink& sink) {
    for (std::size_t level = current_.levels.size(); level-- > 0;) {
        finish_row(previous_.levels[level], band.last_line, sink);
        finish_row(current_.levels[level], band.last_line, sink);
    }
    line_ = band.last_line;
    previous_ = std::move(band.bottom);
    current_.clear();
}

void SweepLine::finish(std::uint32_t root, ContourSink& sink) {
    Component& c = components_[root];
    c.last_row = -1;
    const std::int32_t level = c.level;
    const std::uint32_t below = c.below;
    FinishedContour finished = components_.finish(root);
    std::sort(finished.contour.interiors.begin(), finished.contour.interiors.end(),
              [](const PackedRing& a, const PackedRing& b) { return a.start() < b.start(); });
    PointStats points = finished.contour.own;
    points.merge(finished.contour.above);
    const std::int64_t name = sink.take(std::move(finished));
    if (level == 0)
        return;
    Component& lower = components_[components_.find(below)];
    if (name < 0) {
        lower.own.merge(points);
        return;
    }
    lower.above.merge(points);
    lower.children.push_back(name);
}

}  // namespace d2b::contours
