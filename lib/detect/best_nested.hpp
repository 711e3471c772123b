#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace d2b {

/// One of several things that lie in each other.
struct NestedCandidate {
    static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

    double gain = 0;               ///< of choosing it; only what gains something is ever chosen
    std::size_t holder = nothing;  ///< index of what it lies in, which stands behind it
};

/// Chooses candidates of which none lies in another, so that the sum of their gains is largest: from the
/// inner to the outer, a candidate is chosen where it gains more than the best choice in it (dynamic
/// programming over the trees). Where both gain the same, the inner ones are chosen. Sums are made in the
/// order of the candidates.
/// @param candidates each before its holder
/// @return one a candidate: whether it is chosen
[[nodiscard]] std::vector<bool> best_nested(std::span<const NestedCandidate> candidates);

}  // namespace d2b
