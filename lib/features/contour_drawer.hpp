#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "attributes/records.hpp"
#include "core/context.hpp"
#include "features/polygon_maker.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// What is known of a contour, and what is drawn of it: nothing where its layer was not asked for.
struct DrawnContour {
    ContourKey key;
    std::int64_t parent = -1;          ///< as its head has it
    std::int64_t building_place = -1;  ///< likewise
    bool is_doubtful = false;
    ContourRecord record;  ///< its numbers are those of a run on its list alone
    PointStats own;
    PointStats whole;                ///< with what stands on it
    BuildingRecord building_record;  ///< of level 1 alone
    std::optional<FeaturePolygon> building;
    std::optional<FeaturePolygon> contour;
};

/// Adds the cells that a contour and its building are drawn in, where they are written.
void add_to_stack(const DrawnContour& drawn, const LayerPlaces& places, DrawnStack& stack);

/// Draws contours for the layers that were asked for; on all threads, which have a maker each.
class ContourDrawer {
  public:
    /// @param input must outlive this, as the records must
    ContourDrawer(const FeatureInput& input, const RecordMaker& records, Context& context);
    ContourDrawer(const ContourDrawer&) = delete;
    ContourDrawer& operator=(const ContourDrawer&) = delete;
    ~ContourDrawer() = default;

    /// @param thread that this runs on
    [[nodiscard]] DrawnContour draw(std::size_t contour, std::size_t thread);
    /// Whether the cells that polygons hold come with them, since the stack is measured as it is drawn.
    [[nodiscard]] bool gives_cells() const { return with_cells_; }
    /// One a thread.
    [[nodiscard]] std::vector<PolygonMaker>& makers() { return makers_; }

  private:
    void draw_building(std::size_t contour, PolygonMaker& maker, DrawnContour& drawn) const;

    const FeatureInput& input_;
    const RecordMaker& records_;
    ContourChildren children_;
    bool with_cells_;
    std::vector<PolygonMaker> makers_;
};

/// Which contours of a run the outlines of each depend on. @param target_crs, cell_size_m as below
[[nodiscard]] OutlineReach reach_of(const ContourList& contours, const RunPlan& plan,
                                    const Georeference& georeference, const Crs& crs, const Crs& target_crs,
                                    const Window& window, double cell_size_m, const StopRequest& stop);

/// The outlines of a run, drawn as it was decided. @param target_crs kind none: the DEM's
/// @param cell_size_m side of a square of a cell's area
[[nodiscard]] Outliner draw_outlines(const ContourList& contours, const RunPlan& plan,
                                     const Georeference& georeference, const Crs& crs, const Crs& target_crs,
                                     const Window& window, double cell_size_m, Context& context);

}  // namespace d2b
