#include "detect/piece_graph.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace d2b {
namespace {

double height_difference(const PieceGraph::Piece& a, const PieceGraph::Piece& b) {
    if (a.heights == 0 || b.heights == 0)
        return std::numeric_limits<double>::infinity();
    return std::abs(a.height_sum / static_cast<double>(a.heights) -
                    b.height_sum / static_cast<double>(b.heights));
}

void count_pair(PieceGraph::Piece& piece, Label other, bool beside) {
    // Consecutive pairs along a border mostly have the same neighbour.
    if (piece.borders.empty() || piece.borders.back().other != other)
        piece.borders.push_back({other, 0, 0});
    ++(beside ? piece.borders.back().beside : piece.borders.back().below);
}

}  // namespace

PieceGraph::PieceGraph(Label count, const CellSize& cell)
    : below_length_(cell.across / cell.down), pieces_(count + std::size_t{1}), place_(pieces_.size(), 0) {
    for (Label i = 0; i < count; ++i)
        sets_.add();
}

void PieceGraph::add_pair(Label a, Label b, bool beside) {
    count_pair(pieces_[a], b, beside);
    count_pair(pieces_[b], a, beside);
}

void PieceGraph::tally(Label label) {
    std::vector<Border> sums;
    for (const Border& border : pieces_[label].borders) {
        const Label other = sets_.find(border.other);
        if (other == label)
            continue;
        if (place_[other] == 0) {
            sums.push_back({other, 0, 0});
            place_[other] = sums.size();
        }
        Border& sum = sums[place_[other] - 1];
        sum.beside += border.beside;
        sum.below += border.below;
    }
    for (const Border& sum : sums)
        place_[sum.other] = 0;
    pieces_[label].borders = std::move(sums);
}

bool PieceGraph::better(const Piece& of, const Border& a, const Border& b) const {
    const auto length = [&](const Border& border) {
        return static_cast<double>(border.beside) + static_cast<double>(border.below) * below_length_;
    };
    if (length(a) != length(b))
        return length(a) > length(b);
    const double far_a = height_difference(of, pieces_[a.other]);
    const double far_b = height_difference(of, pieces_[b.other]);
    return far_a != far_b ? far_a < far_b : a.other < b.other;
}

Label PieceGraph::best_neighbour(Label label) const {
    const Piece& piece = pieces_[label];
    const Border* best = nullptr;
    for (const Border& border : piece.borders)
        if (best == nullptr || better(piece, border, *best))
            best = &border;
    return best == nullptr ? 0 : best->other;
}

Label PieceGraph::merge(Label label, Label into) {
    Piece small = std::exchange(pieces_[label], {});
    Piece merged = std::exchange(pieces_[into], {});
    merged.cells += small.cells;
    merged.heights += small.heights;
    merged.height_sum += small.height_sum;
    merged.wide = merged.wide || small.wide;
    merged.borders.insert(merged.borders.end(), small.borders.begin(), small.borders.end());
    const Label kept = sets_.join(label, into);
    pieces_[kept] = std::move(merged);
    return kept;
}

void PieceGraph::merge_small(std::int64_t least_cells) {
    using Entry = std::pair<std::int64_t, Label>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto add = [&](Label label) {
        if (const Piece& piece = pieces_[label]; piece.cells < least_cells || !piece.wide)
            queue.emplace(piece.cells, label);
    };
    for (Label label = 1; label < pieces_.size(); ++label)
        add(label);
    while (!queue.empty()) {
        const auto [cells, label] = queue.top();
        queue.pop();
        // Skips stale entries: a merged piece has another size, or is gone and has none.
        if (pieces_[label].cells != cells)
            continue;
        tally(label);
        if (const Label into = best_neighbour(label); into != 0)
            add(merge(label, into));
    }
}

}  // namespace d2b
