#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scene.hpp"

namespace d2b::sample {

/// A square of land of one character. Each seed gives another one.
struct Place {
    std::string_view name;
    double side = 0;  ///< metres
    Scene (*make)(std::uint64_t seed) = nullptr;
};

/// All of them.
[[nodiscard]] std::span<const Place> places();

[[nodiscard]] Scene village(std::uint64_t seed);    ///< single houses between hedges, farms, a church
[[nodiscard]] Scene hamlet(std::uint64_t seed);     ///< farms with barns among fields and hedgerows
[[nodiscard]] Scene pines(std::uint64_t seed);      ///< an estate under trees that are higher than it
[[nodiscard]] Scene hillside(std::uint64_t seed);   ///< houses and rows of houses on walled terraces
[[nodiscard]] Scene rows(std::uint64_t seed);       ///< rows of equal houses, each on a parcel of its own
[[nodiscard]] Scene outskirts(std::uint64_t seed);  ///< a mall of 260 x 125 m, halls, slabs
[[nodiscard]] Scene park(std::uint64_t seed);       ///< woods, meadows, a brook, a bridge, kiosks
[[nodiscard]] Scene estate(std::uint64_t seed);     ///< single houses with each form of roof
[[nodiscard]] Scene forest(std::uint64_t seed);     ///< closed, on hills: no building
[[nodiscard]] Scene fields(std::uint64_t seed);     ///< furrows, ditches, a dike, bushes: no building

}  // namespace d2b::sample
