#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/surface_cluster.hpp"
#include "surface/level_roofs.hpp"

namespace d2b::features {

/// Problem without id, with its position in the output CRS.
struct PlacedProblem {
    ProblemRecord record;
    Position place;
};

/// Layer of problems met while making surfaces, in the order of note().
class ProblemLayer {
  public:
    /// @param layer index of the layer in the sink; nullopt if the destination does not support it
    explicit ProblemLayer(std::optional<std::size_t> layer) : layer_(layer) {}

    void note(std::vector<PlacedProblem> problems);
    /// Writes all problems, or warns of their number if the destination does not support the layer. @throws
    /// OutputError
    void write(FeatureSink& sink, Context& context) const;

  private:
    std::optional<std::size_t> layer_;
    std::vector<PlacedProblem> problems_;
};

/// Adds the buildings rejected by make_surfaces() to those lost before.
void add_left_out(const DrawnCluster& drawn, const surface::MadeSurfaces& made,
                  std::vector<LostBuilding>& lost);

/// Returns the problems of a cluster's surfaces: resolved non-manifold vertices, and lost buildings with a
/// known position. @param frame of the lattice
[[nodiscard]] std::vector<PlacedProblem> surface_problems(const surface::SurfaceCluster& cluster,
                                                          const surface::MadeSurfaces& made,
                                                          const std::vector<LostBuilding>& lost,
                                                          const SurfaceFrame& frame);

/// Returns the roof steps lower than -min_wall and their resolution.
[[nodiscard]] std::vector<PlacedProblem> step_problems(const surface::SurfaceCluster& cluster,
                                                       const std::vector<surface::RoofStep>& steps,
                                                       const SurfaceFrame& frame);

}  // namespace d2b::features
