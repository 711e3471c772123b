#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace d2b {

/// Histogram with one overflow bin.
template <std::size_t bins>
struct BinCounts {
    std::array<std::int64_t, bins + 1> counts{};
    std::int64_t all = 0;

    void add(std::size_t bin) {
        ++all;
        ++counts[bin];
    }
    void merge(const BinCounts& other) {
        all += other.all;
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] += other.counts[i];
    }
};

}  // namespace d2b
