#pragma once

#include <algorithm>
#include <cmath>

namespace d2b::detect {

/// Odds of a probability, finite even for 1.
[[nodiscard]] inline double odds(double probability) {
    constexpr double least_doubt = 1e-15;
    return probability / std::max(1 - probability, least_doubt);
}

[[nodiscard]] inline double probability_of(double odds) {
    return odds / (1 + odds);
}

/// Lowers the log-odds of a probability.
[[nodiscard]] inline double less_sure(double probability, double log_odds) {
    return probability_of(odds(probability) * std::exp(-log_odds));
}

}  // namespace d2b::detect
