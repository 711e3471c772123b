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

/// The numbers that the contours of one list have in the result.
struct GivenNumbers {
    std::vector<std::int64_t> written;    ///< what stands on a contour that is not written stands on this
    std::vector<std::int64_t> buildings;  ///< by their places in the list
    std::int64_t before = 0;              ///< contours of the list that `written` begins behind
};

/// Hands what is drawn to the layers that were asked for. Contours come in the order of their keys, from one
/// list or from several, and are numbered as they come.
class FeatureWriter {
  public:
    /// @param input must outlive this, as the records and the sink must
    FeatureWriter(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink, Context& context);

    void begin();
    /// @param numbers of the contour's list @param contour place in its list, in whose order those of one
    /// list come
    void add(GivenNumbers& numbers, std::size_t contour, DrawnContour&& drawn) {
        number(numbers, drawn);
        add_numbered(numbers, contour, std::move(drawn));
    }
    /// The first half of add(): gives a contour its numbers.
    void number(GivenNumbers& numbers, DrawnContour& drawn);
    /// The second half, for a contour that has its numbers, from this writer or another.
    void add_numbered(GivenNumbers& numbers, std::size_t contour, DrawnContour&& drawn);
    void finish();
    [[nodiscard]] ContourDrawer& drawer() { return drawer_; }

  private:
    [[nodiscard]] const LayerPlaces& places() const { return input_.layers.places; }
    void count(const DrawnContour& drawn);
    void measure_building(DrawnContour& drawn);
    void add_building(std::size_t contour, DrawnContour& drawn);
    /// @return whether it is in its layer
    bool add_contour(std::size_t contour, DrawnContour& drawn);
    /// As the destination will write it.
    void round(RoundedPolygons::Layer layer, std::int64_t id, std::int64_t parent_id, FeaturePolygon& made);
    void warn_of_traced();
    /// Of the stacks that end at each level, where that is asked for.
    void add_to_cuts(const DrawnContour& drawn);
    void measure_cuts();
    template <typename Record>
    void write(std::size_t layer, std::span<const Attribute<Record>> attributes, const Record& record,
               FeaturePolygon&& made, double threshold);

    const FeatureInput& input_;
    FeatureSink& sink_;
    Context& context_;
    ContourDrawer drawer_;
    StackRmse rmse_;                    // of the contours as they were traced
    std::vector<StackRmse> cut_rmses_;  // the same of the stacks that end at level 1, 2, ...
    StackRmse rmse_below_;              // of what stands below the level that contours have come to
    std::optional<DrawnStack> stack_;   // where they are drawn differently
    std::int64_t next_id_ = 1;
    std::int64_t next_building_ = 1;
    std::optional<RejectedLayer> rejected_;
    std::optional<RoundedPolygons> rounded_;  // where the destination rounds coordinates
    InvalidWarnings invalid_;
    OddHeights odd_heights_;
    TornWarnings torn_;
};

}  // namespace d2b
