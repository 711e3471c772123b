#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ground/line_pass.hpp"
#include "ground/row_pass.hpp"

namespace d2b::ground {

/// Buffers reused between rows.
template <typename T>
struct OpeningRoom {
    RowRoom<T> lines;
    std::vector<T> first;
};

/// Completes an opening (or closing) by a rectangle for a row of extrema along columns: takes the same
/// extremum along the row, then the opposite one. Elements without a value become neutral for the second
/// extremum.
void open_row(std::span<float> row, Extremum first, std::int32_t radius, OpeningRoom<float>& room);
void open_row(std::span<std::int16_t> row, Extremum first, std::int32_t radius,
              OpeningRoom<std::int16_t>& room);

/// Replaces the neutral element of one extremum by that of the other in cells without data.
void turn_row(std::span<float> row, Extremum from);
void turn_row(std::span<std::int16_t> row, Extremum from);

/// Clears cells of `opened` that have no value in `surface`.
void keep_gaps(std::span<const float> surface, std::span<float> opened);
void keep_gaps(std::span<const std::int16_t> surface, std::span<std::int16_t> opened);

}  // namespace d2b::ground
