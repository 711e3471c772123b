#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"

namespace d2b::features {

/// Result of projecting a ring.
enum class RingProjection { whole, split, no_image };

/// Projects rings to another CRS and detects torn ones: across 180 degrees, over a pole, at the edge of a
/// projection. Edges are straight lines in both CRSs. If the midpoint of an edge is projected far from the
/// midpoint of its image, the edge is subdivided; if subdivision does not help, its ends have jumped apart.
/// Not thread-safe: use one object per thread.
class RingTransform {
  public:
    /// @param area positions in `from` that span the area of interest
    /// @param longest maximum edge length projected in one piece, units of `from`; > 0
    /// @param stop polled within long rings, which then throw Cancelled
    /// @throws OptionError if there is no operation between the CRSs
    RingTransform(const Crs& from, const Crs& to, std::span<const Position> area, double longest,
                  StopToken stop = {});

    /// Projects a ring in place. An edge shared by two rings is subdivided alike in both directions.
    /// @param ring at least one position, without a repeated last one
    /// @return whole if the image can be used, otherwise the reason why it cannot
    [[nodiscard]] RingProjection apply(WorldRing& ring);
    /// Same for a ring with elevations. Added vertices lie on the straight edges in between.
    /// @param elevations of the ring's vertices @param projected receives those of the image, at its end
    [[nodiscard]] RingProjection apply_with_elevations(WorldRing& ring, std::span<const double> elevations,
                                                       std::vector<double>& projected);
    /// Projects positions only; those without image become infinite or NaN. @return true if all have an image
    [[nodiscard]] bool apply_to_positions(std::span<Position> positions);

  private:
    /// End of an edge in both CRSs.
    struct End {
        Position source;
        Position image;
    };
    [[nodiscard]] double distance(const Position& a, const Position& b) const;
    [[nodiscard]] bool has_straight_image(const Position& from, const Position& middle,
                                          const Position& to) const;
    [[nodiscard]] RingProjection subdivide_bent_edges(const WorldRing& source, WorldRing& images);
    void subdivide(const End& from, const End& to, int halvings, WorldRing& pieces);

    CoordinateTransform transform_;
    StopToken stop_;
    double longest_;
    double turn_;  ///< target units per full circle of longitude; 0 if it is projected
    // State of the current ring.
    double smooth_ = 0;     ///< total length of edges that are not torn
    double jump_ = 0;       ///< length of the longest torn edge
    std::size_t cuts_ = 0;  ///< number of subdivisions
};

/// Creates the transform from the CRS of a DEM to that of the output, for outlines in a window.
/// @param target kind none: the CRS of the DEM @return nullopt if both are the same
/// @throws OptionError if there is no operation between the CRSs
[[nodiscard]] std::optional<RingTransform> output_transform(const Crs& crs, const Crs& target,
                                                            const Georeference& georeference,
                                                            const Window& window, const StopToken& stop);

/// Returns the length of a closed ring in its own units.
[[nodiscard]] double length_of(std::span<const Position> ring);
/// Returns twice its signed area, computed relative to the first vertex because this cancels no digits of
/// small rings.
[[nodiscard]] double twice_area(std::span<const Position> ring);

/// Returns the bounds of the outlines of a window on the lattice.
[[nodiscard]] LatticeBox lattice_frame(const Window& window, TraceMode mode);

/// True if a line is more than 1000 times as long in a projected CRS as on the ground, because its shape is
/// then lost.
/// @param length in units of the CRS @param ground_m metres
[[nodiscard]] bool is_overstretched(double length, const Crs& crs, double ground_m);

/// Checks that the window of a raster can be represented in the output CRS before any work is done.
/// @param target kind none: the CRS of the DEM
/// @return the centre of the window in the output CRS; not finite if it has no image
/// @throws InputError if the frame of the window is torn, turned inside out or overstretched
/// @throws OptionError if there is no operation between the CRSs
Position require_projectable(const DemInfo& info, const RunPlan& plan, const Crs& crs, const Crs& target);

/// Returns the name of a CRS for messages. @param given name as written by the user, preferred to "unknown"
[[nodiscard]] std::string display_name(const Crs& crs, const std::string& given);

/// @param input name of the raster @param target display name of the output CRS
[[nodiscard]] InputError split_by_projection_error(const std::string& input, const std::string& target);

}  // namespace d2b::features
