#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace d2b {

/// Packs the lowest bits of eight bytes, each 0 or 1; the first byte becomes the lowest bit.
[[nodiscard]] inline std::uint64_t bits_of_eight(const std::uint8_t* cells) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::uint64_t gather = 0x0102040810204080U;  // moves bit 8 i to bit 56 + i without collisions
    std::uint64_t eight = 0;
    std::memcpy(&eight, cells, sizeof eight);
    return (eight * gather) >> 56U;
}

/// Calls use(begin, end) for each run of cells with a value in a row of a mask. Processes 64 cells at a time,
/// and skips words without a transition.
/// @param value 0 or 1
template <typename Use>
void for_mask_runs(std::span<const std::uint8_t> row, std::uint8_t value, const Use& use) {
    constexpr std::size_t step = 64;
    const std::uint64_t turned = value != 0 ? 0 : ~std::uint64_t{0};
    std::uint64_t before = 0;  // 1 if the previous cell belongs to a run
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
        // A run that reaches the end of the row has no transition there if the row fills all 64 bits.
        if (first + cells == row.size() && before != 0)
            use(begin, static_cast<std::int32_t>(row.size()));
    }
}

}  // namespace d2b
