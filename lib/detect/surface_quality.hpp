#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {

/// Histogram with one overflow bin.
template <std::size_t bins>
struct Histogram {
    std::array<std::int64_t, bins + 1> counts{};
    std::int64_t all = 0;

    void add(std::size_t bin) {
        ++all;
        ++counts[bin];
    }
    void merge(const Histogram& other) {
        all += other.all;
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] += other.counts[i];
    }
};

/// Histograms of the differences between neighbours along rows, which show the step that elevations were
/// rounded to. Integer counts, so the order does not matter.
struct StepHistogram {
    static constexpr std::size_t bins = 2000;
    static constexpr double fine_m = 1e-4;  ///< width of a fine bin
    static constexpr double coarse_m =
        5e-3;  ///< width of a coarse bin, which only larger differences fall into

    struct Bin {
        std::int64_t pairs = 0;
        std::int64_t micrometres = 0;  ///< sum over all pairs
    };
    std::int64_t pairs = 0;  ///< pairs of valid neighbours that differ by less than 10 m
    std::int64_t equal = 0;  ///< pairs without a difference
    std::array<Bin, bins> fine{};
    std::array<Bin, bins> coarse{};
    /// Differences between two pairs of equal cells, in coarse bins: a rounded surface rises in these.
    std::array<std::int64_t, bins> risers{};

    /// @param elevations elevations of a row in m
    void add(std::span<const float> elevations);
    void merge(const StepHistogram& other);
};

/// Returns the stride between the rows that are sampled in a large grid.
[[nodiscard]] std::int32_t sampled_row_stride(std::int32_t rows, std::int32_t cols);

/// Estimates the step in m to which elevations were rounded: the smallest frequent difference, if almost all
/// differences of up to 10 m are its multiples. Detects steps from 1 mm to 3 m; 32-bit floats of centimetres
/// are recognised up to some 2,000 m. For steps of a decimetre and more half of the differences suffice,
/// because some cells may have been interpolated after the rounding; but much of the surface has to rise in
/// single steps, because block models with whole heights on level ground are not rounded. Returns nullopt if
/// there is no step.
[[nodiscard]] std::optional<double> value_step(const StepHistogram& counts);
/// Same, for a whole surface.
[[nodiscard]] std::optional<double> value_step(const MetreGrid& surface, Executor& threads);

/// Rounds an estimated step to a round number of units if it is close to one, because floats are slightly
/// off.
[[nodiscard]] double nearest_round_step(double step);

/// Standard deviation of the rounding error, which is uniform over a step.
[[nodiscard]] double rounding_noise(double step);

/// Estimates the standard deviation of the surface's noise in m from open ground, because nothing else bends
/// the surface there from cell to cell. Uses the second differences along rows of cells that are not
/// elevated: the mean between their quantiles 0.1 and 0.2, because gardens and cars bend more than that.
/// Returns 0 if there is hardly any open ground, or if values are repeated or rounded. Integer sums, so the
/// order does not matter.
[[nodiscard]] double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads);

/// Histogram of height differences between neighbours in bins of 5 mm; the first bin counts equal pairs.
using HeightDifferences = Histogram<1000>;
/// Adds one difference.
/// @param difference metres, not negative; NaN is ignored
void add_difference(float difference, HeightDifferences& differences);
/// Returns the differences between elevated, rough neighbours, of which the left or upper one is in a window.
/// @param flags result of smoothness()
[[nodiscard]] HeightDifferences rough_differences(const MetreGrid& surface, const Mask& elevated,
                                                  const Grid<std::uint8_t>& flags, const Window& own,
                                                  Executor& threads);

/// Estimates the share of cells that no laser pulse hit and that were filled with the height of a neighbour,
/// as is common in survey products. It measures how sparse the points are. Only pairs of elevated cells on
/// rough surfaces (crowns and clutter) count, because there two neighbours are equal by chance no more often
/// than they differ by any other small number. Returns 0 if there are too few pairs, or if heights are
/// rounded, because equal heights are then no evidence. Integer sums, so the order does not matter.
/// @param flags result of smoothness()
[[nodiscard]] double interpolated_fraction(const MetreGrid& surface, const Mask& elevated,
                                           const Grid<std::uint8_t>& flags, Executor& threads);
/// Same, from the histogram of these pairs.
[[nodiscard]] double interpolated_fraction(const HeightDifferences& differences);

}  // namespace d2b::detect
