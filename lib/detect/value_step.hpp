#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Histograms of the differences between neighbours along rows, which show the step that elevations were
/// rounded to. Integer counts, so the order does not matter.
struct StepCounts {
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
    void merge(const StepCounts& other);
};

/// Returns the stride between the rows that are sampled in a large grid.
[[nodiscard]] std::int32_t step_stride(std::int32_t rows, std::int32_t cols);

/// Estimates the step in m to which elevations were rounded: the smallest frequent difference, if almost all
/// differences of up to 10 m are its multiples. Detects steps from 1 mm to 3 m; 32-bit floats of centimetres
/// are recognised up to some 2,000 m. For steps of a decimetre and more, much of the surface has to rise in
/// single steps, because block models with whole heights on level ground are not rounded. Returns nullopt if
/// there is no step.
[[nodiscard]] std::optional<double> value_step(const StepCounts& counts);
/// Same, for a whole surface.
[[nodiscard]] std::optional<double> value_step(const MetreGrid& surface, Executor& threads);

/// Rounds an estimated step to a round number of units if it is close to one, because floats are slightly
/// off.
[[nodiscard]] double neat_step(double step);

/// Standard deviation of the rounding error, which is uniform over a step.
[[nodiscard]] double rounding_noise(double step);

}  // namespace d2b
