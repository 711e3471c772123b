#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace d2b {

/// What is tried: every lod with every noise factor and every detail. A list that is empty leaves its option
/// as it is.
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

/// Of a trial's share of a contact sheet: on less its caption cannot be read.
inline constexpr int legible_trial_px = 400;

/// @param longest side of the sheet, in pixels @throws OptionError where it has no room for so many trials
void require_legible(std::size_t trials, int longest);

/// "lod=1..6,nf=5..60": whole numbers from the first to the last, all where they are six or fewer, else six
/// spread evenly; a third number is the step between them ("nf=5..60..5"), and one alone is one value.
/// "detail=0..2..0.5": the same, but any numbers; between two that are not whole six are spread.
/// @throws OptionError where the text is anything else, or names more than 400 trials
[[nodiscard]] SweepPlan parse_sweep(const std::string& text);

}  // namespace d2b
