#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "ground/rows.hpp"

namespace d2b::ground {

inline constexpr std::int32_t widest_narrow = 3;

/// Extrema of lines of 2 * radius + 1 cells along rows or down columns, computed cell by cell, because for
/// short lines that takes fewer steps than sharing work between lines.
template <typename Pick, std::int32_t radius, typename T>
class NarrowPass {
  public:
    /// @param out row other than `in`
    static void along_row(const T* in, std::int32_t cols, T* out) {
        const std::int32_t inner = std::max(cols - radius, radius);
        for (std::int32_t j = radius; j < inner; ++j)
            out[j] = picked([&](std::int32_t k) { return in[j + k]; });
        // Beyond an end, repeats the cell at that end, because it does not change the extremum of a line that
        // contains it.
        const auto at_end = [&](std::int32_t j) {
            out[j] = picked([&](std::int32_t k) { return in[std::clamp(j + k, 0, cols - 1)]; });
        };
        for (std::int32_t j = 0; j < std::min(radius, cols); ++j)
            at_end(j);
        for (std::int32_t j = inner; j < cols; ++j)
            at_end(j);
    }

    /// Computes one row. @param out row of the same length
    static void down_columns(const Rows<const T>& from, std::int32_t i, T* out) {
        across(from, i, out, std::make_integer_sequence<std::int32_t, radius>());
    }

  private:
    template <std::int32_t... k>
    static void across(const Rows<const T>& from, std::int32_t i, T* out,
                       std::integer_sequence<std::int32_t, k...> /*rows*/) {
        const auto row = [&](std::int32_t r) { return from.row(std::clamp(r, 0, from.rows - 1)); };
        down(from.cols, out, row(i), row(i - 1 - k)..., row(i + 1 + k)...);
    }
    template <typename... Row>
    static void down(std::int32_t cols, T* out, const T* here, Row... rows) {
        [[maybe_unused]] const Pick pick;
        for (std::int32_t j = 0; j < cols; ++j) {
            T found = here[j];
            ((found = pick(rows[j], found)), ...);
            out[j] = found;
        }
    }
    template <typename Value>
    static T picked(const Value& value) {
        const Pick pick;
        T found = value(0);
        for (std::int32_t k = 1; k <= radius; ++k)
            found = pick(pick(value(-k), value(k)), found);
        return found;
    }
};

}  // namespace d2b::ground
