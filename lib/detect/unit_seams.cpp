#include "detect/unit_seams.hpp"

#include <utility>

namespace d2b {
namespace {

/// Core of a unit in the grid of its extent.
struct Own {
    std::int32_t row;
    std::int32_t col;
    std::int32_t end_row;
    std::int32_t end_col;
};

using Lines = UnitEdges::Lines;

Lines rows_at(const Grid<Label>& labels, const Own& own, std::int32_t seam) {
    Lines lines;
    for (const std::int32_t side : {0, 1})
        if (seam > 0 && seam < labels.rows) {
            const auto row = labels.row(seam - 1 + side);
            lines[static_cast<std::size_t>(side)].assign(row.begin() + own.col, row.begin() + own.end_col);
        }
    return lines;
}

Lines cols_at(const Grid<Label>& labels, const Own& own, std::int32_t seam) {
    Lines lines;
    for (const std::int32_t side : {0, 1})
        if (seam > 0 && seam < labels.cols)
            for (std::int32_t row = own.row; row < own.end_row; ++row)
                lines[static_cast<std::size_t>(side)].push_back(labels.at(row, seam - 1 + side));
    return lines;
}

void compare(const Lines& first, const Lines& second, UnitMerger& merger) {
    for (std::size_t side = 0; side < first.size(); ++side)
        merger.compare(first[side], second[side]);
}

}  // namespace

void UnitEdges::add(Label more) {
    for (Lines* lines : {&above, &left, &below, &right})
        for (std::vector<Label>& line : *lines)
            for (Label& label : line)
                label += label != 0 ? more : 0;
}

UnitEdges edges_of(const Unit& unit, const Grid<Label>& labels) {
    const Own own{unit.own.row - unit.seen.row, unit.own.col - unit.seen.col,
                  unit.own.end_row() - unit.seen.row, unit.own.end_col() - unit.seen.col};
    return {rows_at(labels, own, own.row), cols_at(labels, own, own.col), rows_at(labels, own, own.end_row),
            cols_at(labels, own, own.end_col)};
}

void UnitSeams::add(std::int32_t col, UnitEdges&& edges, UnitMerger& merger) {
    UnitEdges::Lines& above = above_[static_cast<std::size_t>(col)];
    compare(above, edges.above, merger);
    compare(left_, edges.left, merger);
    above = std::move(edges.below);
    left_ = std::move(edges.right);
}

}  // namespace d2b
