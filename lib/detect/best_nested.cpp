#include "detect/best_nested.hpp"

#include <algorithm>

namespace d2b {

std::vector<bool> best_nested(std::span<const NestedCandidate> candidates) {
    std::vector<double> within(candidates.size(), 0);  // best sum of the candidates inside each
    std::vector<bool> chosen(candidates.size(), false);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        chosen[i] = candidates[i].gain > within[i];  // and thus above 0, because an empty choice is allowed
        if (candidates[i].holder != NestedCandidate::nothing)
            within[candidates[i].holder] += std::max(candidates[i].gain, within[i]);
    }
    std::vector<bool> covered(candidates.size(), false);
    for (std::size_t i = candidates.size(); i-- > 0;) {
        const std::size_t holder = candidates[i].holder;
        covered[i] = holder != NestedCandidate::nothing && (covered[holder] || chosen[holder]);
        if (covered[i])
            chosen[i] = false;
    }
    return chosen;
}

}  // namespace d2b
