#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace d2b {

/// Grid of trials: every lod with every noise factor and every detail. An empty list keeps the option's
/// value.
struct SweepPlan {
    std::vector<int> lods;
    std::vector<int> noise_factors;
    std::vector<double> details;  ///< m

    friend bool operator==(const SweepPlan&, const SweepPlan&) = default;

    [[nodiscard]] std::size_t trials() const {
        return std::max<std::size_t>(lods.size(), 1) * std::max<std::size_t>(noise_factors.size(), 1) *
               std::max<std::size_t>(details.size(), 1);
    }
    [[nodiscard]] bool empty() const { return lods.empty() && noise_factors.empty() && details.empty(); }
};

/// Smallest side of a trial on a contact sheet whose caption is legible.
inline constexpr int legible_trial_px = 400;

/// @param longest side of the sheet, in pixels @throws OptionError if it has no room for that many trials
void require_legible(std::size_t trials, int longest);

/// Parses "lod=1..6,nf=5..60": integers from the first to the last, all if they are six or fewer, otherwise
/// six spread evenly. A third number is the step ("nf=5..60..5"); a single number is one value.
/// "detail=0..2..0.5" also takes fractions; between two that are not integers six are spread. @throws
/// OptionError if the text is anything else, or names more than 400 trials
[[nodiscard]] SweepPlan parse_sweep(const std::string& text);

}  // namespace d2b
