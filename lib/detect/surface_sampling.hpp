#pragma once

#include <cstdint>

#include "core/executor.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "detect/surface_quality.hpp"

namespace d2b::detect {

/// Statistics of the sampling of a surface. Integer counts, so the order does not matter.
struct SurfaceSampling {
    /// Cells on both sides of a building's border within which its step is measured.
    static constexpr std::int32_t reach = 3;

    HeightDifferences rough;    ///< differences between neighbours on rough surfaces
    std::int64_t built = 0;     ///< cells of buildings
    std::int64_t steps = 0;     ///< number of borders with a step
    std::int64_t falls = 0;     ///< sum of their falls over the whole reach, mm
    std::int64_t steepest = 0;  ///< sum of their largest falls between two neighbours, mm
    StepHistogram values;       ///< differences between neighbours

    void merge(const SurfaceSampling& other);
};

/// Adds the core cells of a unit: pairs of rough neighbours, see interpolated_fraction(), and the steps at
/// the borders of buildings. A step is measured along a row or a column, from two cells inside of the last
/// cell of a building to three outside, if the fall exceeds a height and the outside belongs to no object.
/// @param min_height height in m
void add_sampling(const Scene& scene, const Detection& detection, double min_height, const Window& own,
                  SurfaceSampling& sampling, Executor& threads);

/// Derives density, blur and rounding from the counts.
///
/// Points: if chance drops n points into a cell on average, exp(-n) of the cells have none (Poisson);
/// accurate within a quarter for 1.3 to 3 points. The density is overestimated if points are more regular
/// than random. Not reported if the surface is hardly ever rough, because flat roofs of a model are equal
/// without filling.
/// Blur: a wall blurred by a normal distribution of standard deviation s is 2.56 s wide between 10 % and 90 %
/// of its height. The share of its fall between two cells depends on s, so s follows from it; accurate within
/// 15 % on walls along rows and columns blurred by 1 to 2.5 cells.
/// Rounding: see value_step().
/// @param metres metres per vertical unit of the raster
[[nodiscard]] SamplingReport sampling_report(const SurfaceSampling& sampling, double metres);

}  // namespace d2b::detect
