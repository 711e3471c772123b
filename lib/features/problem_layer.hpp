#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

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

}  // namespace d2b
