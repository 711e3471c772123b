#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace d2b {

/// Node of a forest of nested candidates.
struct NestedCandidate {
    static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

    double gain = 0;               ///< gain if chosen; only positive gains are ever chosen
    std::size_t holder = nothing;  ///< index of its parent, which comes after it
};

/// Finds a maximum-weight antichain of a forest: chooses candidates so that none contains another and the sum
/// of their gains is largest. Dynamic programming from the leaves up: a candidate is chosen if it gains more
/// than the best choice inside it; the inner ones win ties. Sums follow the order of the candidates.
/// @param candidates each before its parent
/// @return one flag per candidate
[[nodiscard]] std::vector<bool> best_nested(std::span<const NestedCandidate> candidates);

}  // namespace d2b
