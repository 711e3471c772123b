#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "geometry/overlay.hpp"

namespace d2b::compare {

/// Heights above ground on the grid of a DSM, in whole centimetres: two bytes a cell.
class HeightGrid {
  public:
    HeightGrid(std::int32_t rows, std::int32_t cols, const AffineTransform& transform);

    /// @param part of the grid @param heights_m row by row; NaN: unknown
    void set(const Window& part, std::span<const float> heights_m);
    /// Returns the height in metres of the cell at a position; NaN outside of the grid and if it is unknown.
    [[nodiscard]] double at(const Position& position) const;

  private:
    static constexpr std::uint16_t unknown = 65535;

    std::int32_t rows_;
    std::int32_t cols_;
    AffineTransform transform_;
    double determinant_;
    std::vector<std::uint16_t> centimetres_;
};

/// Heights of a survey in the plane of a comparison.
struct SurveyHeights {
    HeightGrid grid;
    std::function<void(std::span<Position>)>
        to_grid{};      ///< from the plane to the grid's CRS; empty: the same
    Position offset{};  ///< displacement of the survey in the plane

    [[nodiscard]] std::vector<double> at(std::span<const Position> positions) const;
};

/// Positions inside an outline, on a square lattice that is the same for all outlines; by y, then by x.
/// @param step of the lattice, in units of the coordinates
[[nodiscard]] std::vector<Position> positions_in(const Polygons& outline, double step);

}  // namespace d2b::compare
