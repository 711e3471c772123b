#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ground/line_pass.hpp"
#include "ground/row_pass.hpp"

namespace d2b::ground {

/// Kept from one row to the next, so that memory is asked for once.
template <typename T>
struct OpeningRoom {
    RowRoom<T> lines;
    std::vector<T> first;
};

/// Turns a row of the lowest values of elements into the highest of these along the row, or the other way
/// round; before that those along the row are taken as well. An element without a value is the last to be
/// picked then.
void open_row(std::span<float> row, Extremum first, std::int32_t radius, OpeningRoom<float>& room);
void open_row(std::span<std::int16_t> row, Extremum first, std::int32_t radius,
              OpeningRoom<std::int16_t>& room);

/// Where no element holds a value: from what is the last to be picked by one extremum to what is by the
/// other.
void turn_row(std::span<float> row, Extremum from);
void turn_row(std::span<std::int16_t> row, Extremum from);

/// Cells without a value in `surface` have none in `opened`.
void keep_gaps(std::span<const float> surface, std::span<float> opened);
void keep_gaps(std::span<const std::int16_t> surface, std::span<std::int16_t> opened);

}  // namespace d2b::ground
