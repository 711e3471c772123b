#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace d2b {

/// Label of the detected object that a cell belongs to; 0 if it belongs to none.
using Label = std::uint32_t;

/// Whole rows of a window or of a part of it. Row numbers are those of the whole raster; column 0 is the
/// first column of the window or part.
struct BandShape {
    std::int32_t first_row = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols);
    }
    /// Returns a row of values that are stored row by row.
    template <typename T>
    [[nodiscard]] std::span<const T> row(const std::vector<T>& values, std::int32_t i) const {
        const auto length = static_cast<std::size_t>(cols);
        return std::span(values).subspan(static_cast<std::size_t>(i) * length, length);
    }
};

/// Elevations of whole rows; NaN if a point is not valid.
struct ElevationBand {
    BandShape shape;
    std::vector<double> elevations;
    /// Ascending indices of cells that stand above all their surroundings and are not roofs: masts, birds.
    std::vector<std::size_t> spires{};

    [[nodiscard]] std::span<const double> row(std::int32_t i) const { return shape.row(elevations, i); }
    /// Returns the columns of the spires in a row.
    [[nodiscard]] std::vector<std::int32_t> spires_in_row(std::int32_t i) const {
        const std::size_t begin = static_cast<std::size_t>(i) * static_cast<std::size_t>(shape.cols);
        std::vector<std::int32_t> columns;
        for (auto spire = std::ranges::lower_bound(spires, begin);
             spire != spires.end() && *spire < begin + static_cast<std::size_t>(shape.cols); ++spire)
            columns.push_back(static_cast<std::int32_t>(*spire - begin));
        return columns;
    }
};

/// Label of every cell. An empty list means label 1 everywhere, so the thesis preset stores no labels.
struct LabelBand {
    BandShape shape;
    std::vector<Label> labels;

    [[nodiscard]] std::span<const Label> row(std::int32_t i) const {
        return labels.empty() ? std::span<const Label>() : shape.row(labels, i);
    }
};

/// Number of levels that a point belongs to: 0 if it is not valid, 1 if it exceeds no threshold of its label,
/// k + 1 if it exceeds k of them. Stored in 16 bits, or in 8 if no label has more than 254 thresholds.
template <typename Count>
struct LevelBand {
    BandShape shape;
    std::vector<Count> counts;

    [[nodiscard]] std::span<const Count> row(std::int32_t i) const { return shape.row(counts, i); }
};

/// One value per slab of rows of a window, so that processing a band visits only the slabs that overlap it.
template <typename Slab>
class RowSlabs {
  public:
    /// @param first_row of the window @param rows of the window
    RowSlabs(std::int32_t first_row, std::int32_t rows)
        : first_row_(first_row), slabs_(static_cast<std::size_t>(rows / slab_rows + 1)) {}

    /// @param row of the window, numbered as in the whole raster
    [[nodiscard]] std::size_t index(std::int32_t row) const {
        return static_cast<std::size_t>((row - first_row_) / slab_rows);
    }
    [[nodiscard]] Slab& operator[](std::size_t i) { return slabs_[i]; }
    [[nodiscard]] const Slab& operator[](std::size_t i) const { return slabs_[i]; }
    /// Calls use(slab) for each slab that overlaps a band of the window, in ascending order.
    template <typename Use>
    void for_band(const BandShape& band, const Use& use) const {
        if (band.rows == 0)
            return;
        for (std::size_t i = index(band.first_row); i <= index(band.first_row + band.rows - 1); ++i)
            use(slabs_[i]);
    }

  private:
    static constexpr std::int32_t slab_rows = 64;
    std::int32_t first_row_;
    std::vector<Slab> slabs_;
};

}  // namespace d2b
