#include "detect/building_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <utility>

namespace d2b::detect {
namespace {

double height_difference(const PieceAdjacencyGraph::Piece& a, const PieceAdjacencyGraph::Piece& b) {
    if (a.heights == 0 || b.heights == 0)
        return std::numeric_limits<double>::infinity();
    return std::abs(a.height_sum / static_cast<double>(a.heights) -
                    b.height_sum / static_cast<double>(b.heights));
}

void count_pair(PieceAdjacencyGraph::Piece& piece, Label other, bool beside) {
    // Consecutive pairs along a border mostly have the same neighbour.
    if (piece.borders.empty() || piece.borders.back().other != other)
        piece.borders.push_back({other, 0, 0});
    ++(beside ? piece.borders.back().beside : piece.borders.back().below);
}

/// Shifts the labels of doubtful objects to make room for more buildings.
void shift_doubtful(Detection& detection, Label buildings) {
    for (Label& label : detection.labels.values)
        if (label > detection.buildings)
            label += buildings - detection.buildings;
}

}  // namespace

PieceAdjacencyGraph::PieceAdjacencyGraph(Label count, const CellSize& cell)
    : below_length_(cell.across / cell.down), pieces_(count + std::size_t{1}), place_(pieces_.size(), 0) {
    for (Label i = 0; i < count; ++i)
        sets_.add();
}

void PieceAdjacencyGraph::add_pair(Label a, Label b, bool beside) {
    count_pair(pieces_[a], b, beside);
    count_pair(pieces_[b], a, beside);
}

void PieceAdjacencyGraph::merge_duplicate_borders(Label label) {
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

bool PieceAdjacencyGraph::better(const Piece& of, const Border& a, const Border& b) const {
    const auto length = [&](const Border& border) {
        return static_cast<double>(border.beside) + static_cast<double>(border.below) * below_length_;
    };
    if (length(a) != length(b))
        return length(a) > length(b);
    const double far_a = height_difference(of, pieces_[a.other]);
    const double far_b = height_difference(of, pieces_[b.other]);
    return far_a != far_b ? far_a < far_b : a.other < b.other;
}

Label PieceAdjacencyGraph::best_neighbour(Label label) const {
    const Piece& piece = pieces_[label];
    const Border* best = nullptr;
    for (const Border& border : piece.borders)
        if (best == nullptr || better(piece, border, *best))
            best = &border;
    return best == nullptr ? 0 : best->other;
}

Label PieceAdjacencyGraph::merge(Label label, Label into) {
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

void PieceAdjacencyGraph::merge_small(std::int64_t min_cells) {
    using Entry = std::pair<std::int64_t, Label>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto add = [&](Label label) {
        if (const Piece& piece = pieces_[label]; piece.cells < min_cells || !piece.wide)
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
        merge_duplicate_borders(label);
        if (const Label into = best_neighbour(label); into != 0)
            add(merge(label, into));
    }
}

void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection) {
    const Label pieces = *std::max_element(number.begin(), number.end());
    shift_doubtful(detection, pieces);
    std::vector<DetectedObject> objects(pieces);
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        const std::span<Label> cells = detection.labels.row(r).subspan(
            static_cast<std::size_t>(run.begin), static_cast<std::size_t>(run.end - run.begin));
        const Label label = number[run.label];
        DetectedObject& object = objects[label - 1];
        if (object.cells == 0) {
            object = detection.objects[cells.front() - 1];
            object.cells = 0;
        }
        object.cells += run.end - run.begin;
        std::fill(cells.begin(), cells.end(), label);
    });
    objects.insert(objects.end(), detection.objects.begin() + detection.buildings, detection.objects.end());
    detection.objects = std::move(objects);
    detection.buildings = pieces;
}

Mask building_cells(const Detection& detection) {
    const Grid<Label>& labels = detection.labels;
    Mask cells(labels.rows, labels.cols);
    for (std::size_t i = 0; i < cells.size(); ++i)
        cells.values[i] = detection.is_building(labels.values[i]) ? 1 : 0;
    return cells;
}

Grid<Label> piece_grid(const Regions& regions, Executor& threads) {
    std::vector<Label> itself(regions.cells.size());
    std::iota(itself.begin(), itself.end(), Label{0});
    return label_grid(regions, itself, threads);
}

bool fits(const Grid<Label>& pieces, const Element& element, std::int32_t r, std::int32_t c) {
    return std::all_of(element.begin(), element.end(), [&](const ElementRow& part) {
        const std::int32_t y = std::clamp(r + part.down, 0, pieces.rows - 1);
        const auto row = pieces.row(y).begin();
        return std::all_of(row + std::max(c + part.left, 0), row + std::min(c + part.right + 1, pieces.cols),
                           [&](Label label) { return label == pieces.at(r, c); });
    });
}

void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceAdjacencyGraph& graph) {
    const auto pair = [&](std::size_t i, std::size_t j, bool beside) {
        if (pieces.values[i] != 0 && pieces.values[j] != 0 && pieces.values[i] != pieces.values[j] &&
            buildings.values[i] == buildings.values[j])
            graph.add_pair(pieces.values[i], pieces.values[j], beside);
    };
    for (std::int32_t r = 0; r < pieces.rows; ++r)
        for (std::int32_t c = 0; c < pieces.cols; ++c) {
            const std::size_t i = pieces.index(r, c);
            if (c > 0)
                pair(i - 1, i, true);
            if (r > 0)
                pair(i - static_cast<std::size_t>(pieces.cols), i, false);
        }
}

}  // namespace d2b::detect
