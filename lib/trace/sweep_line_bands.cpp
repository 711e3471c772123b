// Sweeping a band of rows independently and attaching it to the rows above.
#include <algorithm>
#include <utility>

#include "trace/sweep_line.hpp"

namespace d2b {

void SweepLine::begin_below(std::int32_t line, const RunRow& squares) {
    line_ = line;
    previous_ = top_ = squares;
    for (std::size_t level = 0; level < top_.levels.size(); ++level)
        for (std::size_t i = 0; i < top_.levels[level].size(); ++i) {
            Run& top = top_.levels[level][i];
            const std::uint32_t below = level == 0 ? no_index : top_.levels[level - 1][top.below].component;
            top.component = components_.add(static_cast<std::int32_t>(level), top.label,
                                            {line_, top.begin + first_col_}, below);
            components_[top.component].open_above = true;
            const Arms::Sides sides =
                arms_.open_above({line_, top.begin + first_col_}, {line_, top.end + first_col_});
            top.head = sides.above.tail;
            top.tail = sides.above.head;
            Run& run = previous_.levels[level][i];
            run.component = top.component;
            run.head = sides.below.head;
            run.tail = sides.below.tail;
        }
}

/// Adds the components of a row to the list of the band, low levels first.
void SweepLine::place_components(OpenBand& band, RunRow& row) {
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
    const std::uint32_t head = arms_.copy_chain(tail, band.corners);
    piece.outside_begin = arms_.outside(tail);
    piece.outside_end = arms_.outside(head);
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
    place_components(band, band.top);
    place_components(band, band.bottom);
    std::vector<bool> at_top(arms_.end());
    for (const std::vector<Run>& runs : band.top.levels)
        for (const Run& run : runs)
            at_top[run.head] = at_top[run.tail] = true;
    // Piece per chain end at its end.
    std::vector<std::uint32_t> piece_to(arms_.end(), no_index);
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
        for (std::int64_t& name : found.standing_on_it)
            name += first_name;
        components.push_back(components_.add(std::move(found)));
    }
    std::vector<Arms::Pair> arms;
    arms.reserve(band.pieces.size());
    for (const OutlinePiece& piece : band.pieces)
        arms.push_back(piece.corners == 0
                           ? Arms::Pair{no_index, no_index}
                           : arms_.add(std::span(band.corners).subspan(piece.first, piece.corners),
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
        Arms::Pair& down = arms[top.head];
        if (down.tail == no_index) {
            arms_.pass(run.head, band.pieces[top.head].outside_end);
            down.head = run.head;
        } else {
            close(run, arms_.connect(run.head, down.tail));
        }
        Arms::Pair& up = arms[top.tail];
        if (up.head == no_index) {
            arms_.pass(run.tail, band.pieces[top.tail].outside_begin);
            up.tail = run.tail;
        } else {
            close(run, arms_.connect(up.head, run.tail));
        }
    });
    for (std::vector<Run>& runs : band.bottom.levels)
        for (Run& run : runs) {
            run.component = components_.find(components[run.component]);
            run.head = arms[run.head].head;
            run.tail = arms[run.tail].tail;
        }
}

}  // namespace d2b
