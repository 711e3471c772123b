#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "attributes/attribute_table.hpp"
#include "diagnose/odd_heights.hpp"
#include "features/contour_drawer.hpp"
#include "features/invalid_warnings.hpp"
#include "features/rejected_layer.hpp"
#include "features/rounded_polygons.hpp"
#include "features/torn_warnings.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// Ids in the result of the contours of one list.
struct GivenNumbers {
    /// By contour; if one is not written, the id of its nearest written ancestor.
    std::vector<std::int64_t> written;
    std::vector<std::int64_t> buildings;  ///< by index in the list
    std::int64_t before = 0;              ///< index in the list of the first element of `written`
};

/// Writes drawn contours to the requested layers. Contours are added in the order of their keys, from one or
/// several lists, and numbered in this order.
class FeatureWriter {
  public:
    /// @param input, records, sink must outlive this
    FeatureWriter(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink, Context& context);

    void begin();
    /// @param numbers of the contour's list @param contour index in its list; ascending within a list
    void add(GivenNumbers& numbers, std::size_t contour, DrawnContour&& drawn) {
        number(numbers, drawn);
        add_numbered(numbers, contour, std::move(drawn));
    }
    /// First half of add(): assigns the ids of a contour.
    void number(GivenNumbers& numbers, DrawnContour& drawn);
    /// Second half of add(), for a contour with ids from this writer or another.
    void add_numbered(GivenNumbers& numbers, std::size_t contour, DrawnContour&& drawn);
    void finish();
    [[nodiscard]] ContourDrawer& drawer() { return drawer_; }

  private:
    [[nodiscard]] const LayerPlaces& places() const { return input_.layers.places; }
    void count(const DrawnContour& drawn);
    void measure_building(DrawnContour& drawn);
    void add_building(std::size_t contour, DrawnContour& drawn);
    /// @return true if it was written
    bool add_contour(std::size_t contour, DrawnContour& drawn);
    /// Rounds coordinates the way the destination will write them.
    void round(RoundedPolygons::Layer layer, std::int64_t id, std::int64_t parent_id, FeaturePolygon& made);
    void warn_of_traced();
    /// Accumulates the errors of truncated stacks.
    void add_to_cuts(const DrawnContour& drawn);
    void measure_cuts();
    template <typename Record>
    void write(std::size_t layer, std::span<const Attribute<Record>> attributes, const Record& record,
               FeaturePolygon&& made, double threshold);

    const FeatureInput& input_;
    FeatureSink& sink_;
    Context& context_;
    ContourDrawer drawer_;
    StackRmse rmse_;                    // of the contours as traced
    std::vector<StackRmse> cut_rmses_;  // same, of the stacks truncated at level 1, 2, ...
    StackRmse rmse_below_;              // of the levels below the current one
    std::optional<DrawnStack> stack_;   // set if drawn outlines differ from traced ones
    std::int64_t next_id_ = 1;
    std::int64_t next_building_ = 1;
    std::optional<RejectedLayer> rejected_;
    std::optional<RoundedPolygons> rounded_;  // set if the destination rounds coordinates
    InvalidWarnings invalid_;
    OddHeights odd_heights_;
    TornWarnings torn_;
};

}  // namespace d2b
