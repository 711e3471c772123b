#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ground/narrow_pass.hpp"

namespace d2b::ground {

/// Buffers reused between rows.
template <typename T>
struct RowRoom {
    std::vector<T> padded;
    std::vector<T> doubled;
};

/// Computes extrema of 2, 4, 8, ... cells by doubling; the last two lines overlap.
template <typename Pick, typename T>
void wide_along_row(const T* in, std::size_t cols, std::size_t reach, RowRoom<T>& room, T* out) {
    const Pick pick;
    const std::size_t width = 2 * reach + 1;
    const std::size_t count = cols + 2 * reach;
    room.padded.resize(count);
    room.doubled.resize(count);
    std::fill_n(room.padded.data(), reach, Pick::template neutral<T>);
    std::copy_n(in, cols, room.padded.data() + reach);
    std::fill_n(room.padded.data() + reach + cols, reach, Pick::template neutral<T>);
    std::size_t span = 1;
    for (; 2 * span <= width; span *= 2) {
        const std::size_t n = count - 2 * span + 1;
        const T* near = room.padded.data();
        const T* far = near + span;
        T* doubled = room.doubled.data();
        for (std::size_t j = 0; j < n; ++j)
            doubled[j] = pick(near[j], far[j]);
        room.padded.swap(room.doubled);
    }
    const T* near = room.padded.data();
    const T* far = near + (width - span);
    for (std::size_t j = 0; j < cols; ++j)
        out[j] = pick(near[j], far[j]);
}

/// Computes the extremum of each line of 2 * radius + 1 cells along a row. @param out row other than `in`
template <typename Pick, std::int32_t narrow = widest_narrow, typename T>
void along_row(const T* in, std::int32_t cols, std::int32_t radius, RowRoom<T>& room, T* out) {
    if (radius > widest_narrow)
        return wide_along_row<Pick>(in, static_cast<std::size_t>(cols), static_cast<std::size_t>(radius),
                                    room, out);
    if constexpr (narrow > 0)
        if (radius < narrow)
            return along_row<Pick, narrow - 1>(in, cols, radius, room, out);
    NarrowPass<Pick, narrow, T>::along_row(in, cols, out);
}

}  // namespace d2b::ground
