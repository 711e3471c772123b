#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "attributes/records.hpp"
#include "core/context.hpp"
#include "features/polygon_maker.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// Records of a contour and its polygons. A polygon is empty if its layer is not written.
struct DrawnContour {
    ContourKey key;
    std::int64_t parent = -1;          ///< index of the parent in the contour list
    std::int64_t building_place = -1;  ///< index of the building in the contour list
    bool is_doubtful = false;
    ContourRecord record;  ///< ids are local to the contour list
    PointStats own;
    PointStats whole;                ///< including the contours above
    BuildingRecord building_record;  ///< level 1 only
    std::optional<FeaturePolygon> building;
    std::optional<FeaturePolygon> contour;
};

/// Adds the drawn cells of a contour and its building to the stack, if they are written.
void add_to_stack(const DrawnContour& drawn, const LayerPlaces& places, DrawnStack& stack);

/// Draws contours for the requested layers. Thread-safe, with one PolygonMaker per thread.
class ContourDrawer {
  public:
    /// @param input, records must outlive this
    ContourDrawer(const FeatureInput& input, const RecordMaker& records, Context& context);
    ContourDrawer(const ContourDrawer&) = delete;
    ContourDrawer& operator=(const ContourDrawer&) = delete;
    ~ContourDrawer() = default;

    /// @param thread index of the calling thread
    [[nodiscard]] DrawnContour draw(std::size_t contour, std::size_t thread);
    /// True if polygons come with their cells, because the stack error is measured on them.
    [[nodiscard]] bool gives_cells() const { return with_cells_; }
    /// Returns the makers, one per thread.
    [[nodiscard]] std::vector<PolygonMaker>& makers() { return makers_; }

  private:
    void draw_building(std::size_t contour, PolygonMaker& maker, DrawnContour& drawn) const;

    const FeatureInput& input_;
    const RecordMaker& records_;
    ContourChildren children_;
    bool with_cells_;
    std::vector<PolygonMaker> makers_;
};

/// Groups contours whose outlines depend on each other. @param target_crs, cell_size_m see below
[[nodiscard]] OutlineReach reach_of(const ContourList& contours, const RunPlan& plan,
                                    const Georeference& georeference, const Crs& crs, const Crs& target_crs,
                                    const Window& window, double cell_size_m, const StopRequest& stop);

/// Draws the outlines of a run by its plan. @param target_crs kind none: the CRS of the DEM
/// @param cell_size_m side of a square with the area of a cell
[[nodiscard]] Outliner draw_outlines(const ContourList& contours, const RunPlan& plan,
                                     const Georeference& georeference, const Crs& crs, const Crs& target_crs,
                                     const Window& window, double cell_size_m, Context& context);

}  // namespace d2b
