#pragma once

#include <cstddef>
#include <cstdint>

namespace d2b {

/// Calls use(begin, end, value) for each run of equal nonzero cells of a row.
template <typename Row, typename Use>
void for_equal_runs(const Row& row, const Use& use) {
    for (std::size_t begin = 0; begin < row.size();) {
        const auto value = row[begin];
        std::size_t end = begin + 1;
        while (end < row.size() && row[end] == value)
            ++end;
        if (value != 0)
            use(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), value);
        begin = end;
    }
}

}  // namespace d2b
