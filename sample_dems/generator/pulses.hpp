#pragma once

#include <cstdint>
#include <vector>

#include "render.hpp"
#include "survey.hpp"

namespace d2b::sample {

/// A pulse on its way down.
struct Pulse {
    Position at;
    std::uint64_t draw = 0;  ///< a number of its own, for decisions by chance
};

/// Pulses by the cell in which they come down.
struct PulseRows {
    std::vector<std::size_t> first;  ///< by cell of these rows, and one more
    std::vector<Pulse> pulses;
};

/// The pulses over some rows: one at a random place in each square of a lattice, as even as the lines of a
/// scanner are, and of these the share that is kept. A pulse depends on the seed and its square alone, so
/// rows can be had in any portions.
[[nodiscard]] PulseRows pulses_over(const Grid& grid, const Survey& survey, std::uint64_t seed,
                                    std::int32_t first_row, std::int32_t rows);

}  // namespace d2b::sample
