#include "roofs/building_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace d2b::roofs {

BuildingGrid make_building_grid(const contours::BuildingCells& cells, const LatticeBox& box,
                                std::int32_t margin, const CellSize& cell, double metres) {
    std::int32_t first_row = box.low.row;
    std::int32_t first_col = box.low.col;
    std::int32_t end_row = box.high.row;
    std::int32_t end_col = box.high.col;
    for (const RowSpan& run : cells.runs) {
        first_row = std::min(first_row, run.row);
        first_col = std::min(first_col, run.begin);
        end_row = std::max(end_row, run.row + 1);
        end_col = std::max(end_col, run.end);
    }
    BuildingGrid grid;
    grid.first_row = first_row - margin;
    grid.first_col = first_col - margin;
    grid.rows = end_row - first_row + 2 * margin;
    grid.cols = end_col - first_col + 2 * margin;
    grid.cell_m = std::sqrt(cell.across * cell.down);
    grid.x_step = cell.across / grid.cell_m;
    grid.y_step = cell.down / grid.cell_m;
    grid.sine = cell.sine;
    grid.cosine = cell.cosine;
    const auto size = grid.index(grid.rows, 0);
    grid.elevations.assign(size, std::numeric_limits<float>::quiet_NaN());
    grid.inside.assign(size, 0);
    const auto valid = std::ranges::find_if(cells.elevations, [](double z) { return !std::isnan(z); });
    grid.datum = valid == cells.elevations.end() ? 0 : *valid * metres;
    std::size_t next = 0;
    for (const RowSpan& run : cells.runs)
        for (std::int32_t col = run.begin; col < run.end; ++col, ++next) {
            const std::size_t i = grid.index(run.row - grid.first_row, col - grid.first_col);
            grid.inside[i] = 1;
            grid.elevations[i] = static_cast<float>(cells.elevations[next] * metres - grid.datum);
        }
    return grid;
}

namespace {

constexpr std::int32_t nowhere = std::numeric_limits<std::int32_t>::max();

/// Row of the nearest labelled cell of each cell's column; `nowhere` if there is none.
std::vector<std::int32_t> nearest_rows(const std::vector<std::int32_t>& labels, std::int32_t rows,
                                       std::int32_t cols) {
    const auto width = static_cast<std::size_t>(cols);
    std::vector<std::int32_t> nearest(labels.size(), nowhere);
    for (std::size_t col = 0; col < width; ++col) {
        std::int32_t last = nowhere;
        for (std::int32_t row = 0; row < rows; ++row) {
            const std::size_t i = static_cast<std::size_t>(row) * width + col;
            if (labels[i] >= 0)
                last = row;
            nearest[i] = last;
        }
        last = nowhere;
        for (std::int32_t row = rows - 1; row >= 0; --row) {
            const std::size_t i = static_cast<std::size_t>(row) * width + col;
            if (labels[i] >= 0)
                last = row;
            if (last != nowhere && (nearest[i] == nowhere || last - row < row - nearest[i]))
                nearest[i] = last;
        }
    }
    return nearest;
}

/// Lower envelope of the parabolas of a row: the column of the nearest cell from each column on.
class Envelope {
  public:
    void begin() { parts_.clear(); }
    /// @param squared distance within the column
    void add(std::int32_t col, double squared) {
        double from = -std::numeric_limits<double>::infinity();
        while (!parts_.empty()) {
            const Part& last = parts_.back();
            const double here = col;
            const double there = last.col;
            from = (squared + here * here - last.squared - there * there) / (2 * (here - there));
            if (from > last.from)
                break;
            parts_.pop_back();
            from = -std::numeric_limits<double>::infinity();
        }
        parts_.push_back({col, squared, from});
    }
    [[nodiscard]] bool empty() const { return parts_.empty(); }
    /// Calls use(col, nearest col, squared distance) for the columns from the first to the last.
    template <typename Use>
    void for_each(std::int32_t cols, const Use& use) const {
        std::size_t part = 0;
        for (std::int32_t col = 0; col < cols; ++col) {
            while (part + 1 < parts_.size() && parts_[part + 1].from <= col)
                ++part;
            const double across = col - parts_[part].col;
            use(col, parts_[part].col, across * across + parts_[part].squared);
        }
    }

  private:
    struct Part {
        std::int32_t col;
        double squared;
        double from;
    };
    std::vector<Part> parts_;
};

}  // namespace

NearestLabels nearest_labels(const std::vector<std::int32_t>& labels, std::int32_t rows, std::int32_t cols) {
    NearestLabels result{std::vector<std::int32_t>(labels.size(), -1),
                         std::vector<float>(labels.size(), std::numeric_limits<float>::infinity())};
    const std::vector<std::int32_t> nearest = nearest_rows(labels, rows, cols);
    const auto width = static_cast<std::size_t>(cols);
    Envelope envelope;
    for (std::int32_t row = 0; row < rows; ++row) {
        const std::size_t first = static_cast<std::size_t>(row) * width;
        envelope.begin();
        for (std::int32_t col = 0; col < cols; ++col)
            if (const std::int32_t at = nearest[first + static_cast<std::size_t>(col)]; at != nowhere)
                envelope.add(col, static_cast<double>(at - row) * (at - row));
        if (envelope.empty())
            continue;
        envelope.for_each(cols, [&](std::int32_t col, std::int32_t from, double squared) {
            const std::int32_t at = nearest[first + static_cast<std::size_t>(from)];
            const std::size_t i = first + static_cast<std::size_t>(col);
            result.labels[i] = labels[static_cast<std::size_t>(at) * width + static_cast<std::size_t>(from)];
            result.distances[i] = static_cast<float>(std::sqrt(squared));
        });
    }
    return result;
}

}  // namespace d2b::roofs
