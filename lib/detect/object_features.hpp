#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "detect/smoothness.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// Surroundings and gradients of an object, summed over its border cells.
class BorderSums {
  public:
    /// Adds a border cell.
    /// @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, std::int32_t c);

    /// Mean height above the ground of cells within two cells of the border that belong to no object; 0 if
    /// there are none.
    [[nodiscard]] double height_beside() const;
    /// Rectangularity: 1 if all gradients at the border follow two perpendicular directions, as the walls of
    /// a rectangle do, about 0 for round objects. It is the length of the mean of the gradients at four times
    /// their angle, weighted by their size.
    [[nodiscard]] double right_angles() const;

  private:
    void add_gradient(const MetreGrid& surface, std::int32_t r, std::int32_t c);

    double heights_ = 0;
    double cells_ = 0;  // number of cells summed in heights_
    double cosine_ = 0;
    double sine_ = 0;
    double gradients_ = 0;
};

/// Second moments of an object, from which its compactness follows: small houses are compact, groups of
/// bushes and parts of crowns have arms and bays.
class ShapeMoments {
  public:
    /// Adds a run. Runs come in scan order and are measured from the first cell, so that the sums do not
    /// depend on the object's position.
    void add(std::int32_t r, const RegionRun& run);

    /// Area divided by the area of the ellipse with the same second moments. Invariant under affine maps:
    /// 0.955 for parallelograms, 1 for ellipses, less for shapes with arms. Cells count as squares, not as
    /// points. Returns 1 if there are no cells.
    [[nodiscard]] double compactness() const;
    /// Returns the variance in m2 along the longest axis: L^2 / 12 for a strip of length L. 0 if there are no
    /// cells.
    [[nodiscard]] double largest_variance(const CellSize& cell) const;

  private:
    /// Central second moments per cell, in cells.
    struct Variances {
        double down = 0;
        double across = 0;
        double down_across = 0;
    };
    [[nodiscard]] Variances variances() const;

    std::int32_t first_row_ = 0;
    std::int32_t first_col_ = 0;
    double cells_ = 0;
    // Sums over cell centres, relative to the first one.
    double down_ = 0;
    double across_ = 0;
    double down_down_ = 0;
    double across_across_ = 0;
    double down_across_ = 0;
};

/// Share of neighbouring cells of an object whose height difference is that of a roof. In sparse scans crowns
/// have heights from anywhere within them, so that adjacent cells differ by metres.
class LowSlopePairs {
  public:
    /// Adds the pairs of a run with the next cell and with the cell below.
    /// @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, const RegionRun& run);

    /// Share of pairs with a slope below 0.55, which is steeper than most roofs; 1 if there are no pairs.
    [[nodiscard]] double share() const;

  private:
    std::int64_t pairs_ = 0;
    std::int64_t low_slope_ = 0;
};

/// Rectangularity that is equally common among crowns and buildings in ambiguous cases, see BorderSums.
constexpr double neutral_right_angles = 0.3;
/// Compactness that is equally common among small crowns and small buildings, see ShapeMoments.
constexpr double neutral_compactness = 0.905;

/// Features of an object, the input of the classifier.
struct ObjectFeatures {
    double smooth = 0;    ///< share of its cells that are smooth enough
    double step_m = 0;    ///< mean fall of its border cells to their lowest neighbour
    double tilt = 0;      ///< tilt of its segments: geometric mean over cells
    double segment = 0;   ///< size of its segments in cells: geometric mean over cells
    double green = 0;     ///< share of its cells with the NDVI of plants
    double walled = 1;    ///< share of its border at which the surface bends like a wall; the raster's own
                          ///< border is ignored; 1 if there is no other border
    double fall = 0;      ///< mean slope of its border down to the lowest neighbour (m/m)
    double beside_m = 0;  ///< mean height of its surroundings, see BorderSums
    double right_angles = neutral_right_angles;  ///< rectangularity of its border, see BorderSums
    double area_m2 = 1;
    double low_slope_ratio = 1;  ///< share of neighbouring cells with the slope of a roof, see LowSlopePairs
    double compactness = neutral_compactness;  ///< see ShapeMoments
    /// Same as step_m without the raster's own border; infinite if there is no other border.
    double wall_m = std::numeric_limits<double>::infinity();
};

/// Objects detected so far.
struct ObjectRegions {
    Mask cells;
    Regions regions;  ///< 4-connected regions of these cells
};

/// Computes the features of each region, by label - 1. Halo: objects, and a cell around them.
[[nodiscard]] std::vector<ObjectFeatures> compute_features(const Scene& scene, const ObjectRegions& objects,
                                                           const SmoothSegments& segments,
                                                           const Grid<std::uint8_t>& flags,
                                                           Executor& threads);

/// Classifies an object by a logistic model of eleven terms. Its weights were fitted to cities with cells of
/// 0.5 to 5 m, and validated by leaving out one city at a time, see docs/accuracy.md. Objects almost without
/// walls, sharp or blurred, are terrain, however smooth and large they are, so their confidence is 0. A term
/// that took no part is never reported as the doubt.
/// In sparse scans crowns have steps like walls, and few cells of a house are smooth. Therefore other terms
/// replace smoothness, step and tilt as the share of filled cells rises.
/// @param filled share of cells without a pulse, see interpolated_fraction()
[[nodiscard]] DetectedObject classify(const ObjectFeatures& features, double filled = 0);

/// Score of a part of an object for being a roof: the usual sum of classify() without the terms for
/// vegetation and right angles, because one side of the part's border is inside a roof. Parts are small, so
/// the size of their segments counts a quarter.
[[nodiscard]] double roof_score(const ObjectFeatures& part);

}  // namespace d2b::detect
