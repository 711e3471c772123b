#pragma once

#include <cstdint>

#include "core/executor.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"
#include "detect/filled_share.hpp"
#include "detect/scene.hpp"
#include "detect/value_step.hpp"

namespace d2b {

/// How finely a surface was sampled, as whole numbers: they add up whatever their order.
struct SurfaceSampling {
    /// Cells on both sides of the border of a building that its step is looked for in.
    static constexpr std::int32_t reach = 3;

    HeightDifferences rough;    ///< of neighbours where the surface is rough
    std::int64_t built = 0;     ///< cells of buildings
    std::int64_t steps = 0;     ///< places where a building ends in one
    std::int64_t falls = 0;     ///< of these together, over all that is looked at, mm
    std::int64_t steepest = 0;  ///< of these together, the largest between two neighbours, mm
    StepCounts values;          ///< differences between neighbours

    void merge(const SurfaceSampling& other);
};

/// Adds what the own cells of a unit say: pairs of rough neighbours, see filled_share(), and the steps at the
/// border of buildings. A step is looked at along a row or a column, from two cells inside of the last cell
/// of a building to three outside, where it falls by more than a height and what is outside belongs to
/// nothing.
/// @param min_height metres
void add_sampling(const Scene& scene, const Detection& detection, double min_height, const Window& own,
                  SurfaceSampling& sampling, Executor& threads);

/// What the counts say. Of points nothing, where a surface is next to nowhere rough: the flat roofs of a
/// model are equal without them. Where chance drops n points into a cell on the mean, exp(-n) of the cells
/// have none (Poisson); found within a quarter for 1.3 to 3 points. Where points lie more evenly than by
/// chance there are fewer of them than is said. A wall that a normal distribution of standard deviation s has
/// blurred is 2.56 s wide between a tenth and nine tenths of its height; how much of its fall lies between
/// two cells follows from s, and so s from that. Found within 15 % on walls along rows and columns that were
/// blurred by 1 to 2.5 cells. For the step of the values see value_step().
/// @param metres in the vertical unit of the raster
[[nodiscard]] SamplingReport sampling_report(const SurfaceSampling& sampling, double metres);

}  // namespace d2b
