#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace d2b {

/// The lowest bits of eight bytes, which are 0 or 1, side by side; the first byte's is the lowest.
[[nodiscard]] inline std::uint64_t bits_of_eight(const std::uint8_t* cells) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::uint64_t gather = 0x0102040810204080U;  // moves bit 8 i to bit 56 + i; no two meet
    std::uint64_t eight = 0;
    std::memcpy(&eight, cells, sizeof eight);
    return (eight * gather) >> 56U;
}

/// Calls use(begin, end) for each run of cells of a value in a row of a mask: 64 cells at a time, of which
/// those where nothing begins or ends take no further step.
/// @param value 0 or 1
template <typename Use>
void for_mask_runs(std::span<const std::uint8_t> row, std::uint8_t value, const Use& use) {
    constexpr std::size_t step = 64;
    const std::uint64_t turned = value != 0 ? 0 : ~std::uint64_t{0};
    std::uint64_t before = 0;  // whether the cell before belongs to a run
    std::int32_t begin = 0;
    for (std::size_t first = 0; first < row.size(); first += step) {
        const std::size_t cells = row.size() - first < step ? row.size() - first : step;
        std::uint64_t in = 0;
        std::size_t c = 0;
        for (; c + 8 <= cells; c += 8)
            in |= bits_of_eight(row.data() + first + c) << c;
        for (; c < cells; ++c)
            in |= std::uint64_t{row[first + c]} << c;
        in ^= turned;
        if (cells < step)
            in &= (std::uint64_t{1} << cells) - 1;
        for (std::uint64_t turns = in ^ (in << 1U | before); turns != 0; turns &= turns - 1) {
            const auto at = static_cast<std::int32_t>(first) + std::countr_zero(turns);
            if ((in >> static_cast<unsigned>(at - static_cast<std::int32_t>(first)) & 1U) != 0)
                begin = at;
            else
                use(begin, at);
        }
        before = in >> (step - 1);
        // What reaches the row's end has no turn there where the row fills all bits.
        if (first + cells == row.size() && before != 0)
            use(begin, static_cast<std::int32_t>(row.size()));
    }
}

}  // namespace d2b
