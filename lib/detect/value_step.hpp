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

/// Differences between neighbours along rows, as whole numbers: they add up whatever their order. Their sizes
/// show the step that elevations were rounded to.
struct StepCounts {
    static constexpr std::size_t bins = 2000;
    static constexpr double fine_m = 1e-4;    ///< width of a fine bin
    static constexpr double coarse_m = 5e-3;  ///< of a coarse bin, which only larger differences fall into

    struct Bin {
        std::int64_t pairs = 0;
        std::int64_t micrometres = 0;  ///< of all together
    };
    std::int64_t pairs = 0;  ///< of known neighbours that differ by less than 10 m
    std::int64_t equal = 0;  ///< of these
    std::array<Bin, bins> fine{};
    std::array<Bin, bins> coarse{};
    /// Differences between two pairs of equal cells, in coarse bins: a rounded surface rises in these.
    std::array<std::int64_t, bins> risers{};

    /// @param elevations of a row, metres
    void add(std::span<const float> elevations);
    void merge(const StepCounts& other);
};

/// Rows of a large grid that are not looked at between two that are.
[[nodiscard]] std::int32_t step_stride(std::int32_t rows, std::int32_t cols);

/// The step that elevations were rounded to, in metres: almost all differences of up to 10 m are multiples of
/// it, and the smallest that is at all frequent is it. Steps from 1 mm to 3 m are told; 32-bit floats of
/// centimetres are known as such up to some 2,000 m. From a decimetre on much of the surface has to rise in
/// single steps: blocks of whole heights on a level ground are not rounded. Nothing where there is no step.
[[nodiscard]] std::optional<double> value_step(const StepCounts& counts);
/// Of a whole surface.
[[nodiscard]] std::optional<double> value_step(const MetreGrid& surface, Executor& threads);

/// A step as it was meant, where it is as good as a round number of units: floats err a little.
[[nodiscard]] double neat_step(double step);

/// The standard deviation of what rounding adds or takes, which is evenly distributed over a step.
[[nodiscard]] double rounding_noise(double step);

}  // namespace d2b
