#pragma once

#include <vector>

#include "attributes/percentiles.hpp"
#include "filter/noise.hpp"

namespace d2b {

/// All contours that are kept, sorted by key; a contour's number is its index plus one.
struct ContourSet {
    std::vector<Contour> contours;         ///< parent: index into this list
    std::vector<std::int64_t> building;    ///< a contour: index into `buildings`, -1 in level 0
    std::vector<std::int64_t> buildings;   ///< the contours of level 1, in order
    std::vector<Percentiles> percentiles;  ///< a building
};

/// Takes the roots out, so that footprints are the lowest contours.
void drop_roots(ContourSet& set);

/// Takes stacks as they are finished, drops their noise, and keeps the rest in about one byte a corner.
class ContourStore : public StackSink {
  public:
    ContourStore(const FilterOptions& options, SquareArea square_area, const ElevationRange& range,
                 Context& context);

    Taken take(Stack&& stack) override;
    /// After the last stack: sorts, numbers and fills holes. The store is empty afterwards.
    [[nodiscard]] ContourSet finish();

  private:
    FilterOptions options_;
    SquareArea square_area_;
    ElevationRange range_;
    Context& context_;
    std::vector<Contour> contours_;         ///< parent: index into this list
    std::vector<Percentiles> percentiles_;  ///< of the stacks of level 1, by the order in which they came
    std::vector<std::int64_t> bases_;       ///< their lowest contours
};

}  // namespace d2b
