#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A problem that has no number yet, and where it is, in the CRS of the output.
struct PlacedProblem {
    ProblemRecord record;
    Position place;
};

/// The layer of places that were in the way of a surface, in the order in which they are noted.
class ProblemLayer {
  public:
    /// @param layer index of the layer in the sink; nothing where the destination has no room for it
    explicit ProblemLayer(std::optional<std::size_t> layer) : layer_(layer) {}

    void note(std::vector<PlacedProblem> problems);
    /// Writes all, or warns of how many the destination has no room for. @throws OutputError
    void write(FeatureSink& sink, Context& context) const;

  private:
    std::optional<std::size_t> layer_;
    std::vector<PlacedProblem> problems_;
};

}  // namespace d2b
