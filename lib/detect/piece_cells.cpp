#include "detect/piece_cells.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace d2b {

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

void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceGraph& graph) {
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

}  // namespace d2b
