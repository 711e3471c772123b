#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/stop_request.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// What becomes of a ring in another CRS.
enum class RingFate { whole, torn, without_image };

/// Brings rings to another CRS, and looks for those that it tears apart: across 180 degrees, over a pole, at
/// the edge of a projection. Edges are straight in both; where the middle of one is far from the middle of
/// its image, the edge is cut. Where no cutting helps, its ends have jumped apart. One object a thread.
class RingTransform {
  public:
    /// @param area positions (of `from`) that span the area of interest
    /// @param longest edge that is brought over in one piece, units of `from`; > 0
    /// @param stop asked within long rings: they end with a Cancelled
    /// @throws OptionError where there is no operation between the two
    RingTransform(const Crs& from, const Crs& to, std::span<const Position> area, double longest,
                  StopRequest stop = {});

    /// In place. An edge that two rings share is cut alike in both, whichever way they run.
    /// @param ring at least one position, not closed by a repeated one
    /// @return whether it can be used: not where it is torn, or a position has no image
    [[nodiscard]] RingFate apply(WorldRing& ring);
    /// Positions alone; what has no image becomes infinite or NaN. @return whether all have one
    [[nodiscard]] bool apply_to_positions(std::span<Position> positions);

  private:
    /// An end of an edge, before and after.
    struct End {
        Position source;
        Position image;
    };
    [[nodiscard]] double distance(const Position& a, const Position& b) const;
    [[nodiscard]] bool runs_straight(const Position& from, const Position& middle, const Position& to) const;
    [[nodiscard]] RingFate cut_where_bent(const WorldRing& source, WorldRing& images);
    void cut(const End& from, const End& to, int halvings, WorldRing& pieces);

    CoordinateTransform transform_;
    StopRequest stop_;
    double longest_;
    double turn_;  ///< units of the target in a full circle of longitude, 0 where it has lengths
    // Of the ring at hand.
    double smooth_ = 0;     ///< length of what is known to run from end to end
    double jump_ = 0;       ///< longest edge that has jumped apart
    std::size_t cuts_ = 0;  ///< that were made where edges bend
};

/// From the CRS of a DEM to that of the output, for outlines in a window.
/// @param target kind none: that of the DEM @return nothing where both are the same
/// @throws OptionError where there is no operation between the two
[[nodiscard]] std::optional<RingTransform> output_transform(const Crs& crs, const Crs& target,
                                                            const Georeference& georeference,
                                                            const Window& window, const StopRequest& stop);

/// Length of a closed ring in its own units.
[[nodiscard]] double length_of(std::span<const Position> ring);

}  // namespace d2b
