#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/attribute_table.hpp"
#include "features/contour_drawer.hpp"
#include "features/roof_layer.hpp"
#include "features/rounded_polygons.hpp"
#include "features/suspicious_values.hpp"
#include "features/write_features.hpp"

namespace d2b::features {

/// Warns of features that were not written as drawn because GEOS rejected them. The first few are named with
/// GEOS's reason, all others are only counted.
class InvalidWarnings {
  public:
    explicit InvalidWarnings(Context& context) : context_(context) {}

    /// @param kind "Building" or "Contour" @param made polygon, valid or not
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    void finish();

  private:
    Context& context_;
    std::int64_t count_ = 0;
};

/// Warns of features left out because the output CRS tears them. Names the first few in one sentence.
class ProjectionSplitWarnings {
  public:
    /// @param kind "building" or "contour" @param made polygon, torn or not
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    /// @param target display name of the output CRS @throws InputError if nothing else was written
    void finish(const std::string& target, Context& context) const;

  private:
    std::string names_;
    std::int64_t count_ = 0;
};

/// Layer of contours that were dropped, filled or changed: their traced shape with the reason.
class RejectedLayer {
  public:
    /// @param input must outlive this @param layer index of the layer in the sink
    RejectedLayer(const FeatureInput& input, std::size_t layer) : input_(input), layer_(layer) {}

    /// Records a contour with a polygon that differs from the requested one.
    void note(std::size_t contour, LayerRole role, std::int64_t id, const FeaturePolygon& made);
    /// Writes contours dropped or filled by filters, in the order of keys, followed by the recorded ones.
    /// @param makers one per thread @param rounded null if the destination does not round
    /// @throws OutputError
    void write(std::vector<PolygonMaker>& makers, FeatureSink& sink, RoundedPolygons* rounded,
               Context& context) const;

  private:
    struct Changed {
        std::size_t contour;
        RejectedRecord record;
    };
    struct Drawn {
        RejectedRecord record;
        FeaturePolygon made;
    };
    [[nodiscard]] Drawn draw(std::size_t i, PolygonMaker& maker) const;

    const FeatureInput& input_;
    std::size_t layer_;
    std::vector<Changed> changed_;
};

/// Ids of a building, of the building that it is a part of, and of its first face.
struct BuildingIds {
    std::int64_t id = 0;
    std::int64_t whole = 0;  ///< 0: not divided
    std::int64_t first_face = 0;

    friend bool operator==(const BuildingIds&, const BuildingIds&) = default;
};

/// Ids in the result of the contours of one list.
struct AssignedIds {
    /// By contour; if one is not written, the id of its nearest written ancestor.
    std::vector<std::int64_t> written;
    std::vector<BuildingIds> buildings;  ///< by index in the list
    std::int64_t before = 0;             ///< index in the list of the first element of `written`
};

/// Writes drawn contours to the requested layers. Contours are added in the order of their keys, from one or
/// several lists, and numbered in this order.
class FeatureWriter {
  public:
    /// @param input, records, sink must outlive this
    FeatureWriter(const FeatureInput& input, const RecordBuilder& records, FeatureSink& sink,
                  Context& context);

    void begin();
    /// @param numbers of the contour's list @param contour index in its list; ascending within a list
    void add(AssignedIds& numbers, std::size_t contour, DrawnContour&& drawn) {
        assign_ids(numbers, drawn);
        numbers.written.push_back(add_with_ids(contour, std::move(drawn)));
    }
    /// First half of add(): assigns the ids of a contour.
    void assign_ids(AssignedIds& numbers, DrawnContour& drawn);
    /// Second half of add(), for a contour with ids from this writer or another.
    /// @return its element of AssignedIds::written
    std::int64_t add_with_ids(std::size_t contour, DrawnContour&& drawn);
    /// Completes the layers and the report, with the error of the stack of contours as traced.
    /// @return the stack as drawn, if its error is to be reported instead; that needs the elevations again
    [[nodiscard]] std::optional<DrawnStack> finish();
    [[nodiscard]] ContourDrawer& drawer() { return drawer_; }

  private:
    [[nodiscard]] const LayerIndices& indices() const { return input_.setup.layers.indices; }
    /// Assigns the ids of the next building.
    [[nodiscard]] BuildingIds assign_building(DrawnContour& drawn);
    void count(const DrawnContour& drawn);
    void measure_building(DrawnContour& drawn);
    void add_building(std::size_t contour, DrawnContour& drawn);
    /// @return true if it was written
    bool add_contour(std::size_t contour, DrawnContour& drawn);
    /// Rounds coordinates the way the destination will write them.
    void round(LayerRole layer, std::int64_t id, std::int64_t parent_id, FeaturePolygon& made);
    void warn_of_traced();
    /// Accumulates the errors of truncated stacks.
    void add_to_cuts(const DrawnContour& drawn);
    template <typename Record>
    void write(std::size_t layer, std::span<const Attribute<Record>> attributes, const Record& record,
               FeaturePolygon&& made, double threshold);

    const FeatureInput& input_;
    FeatureSink& sink_;
    Context& context_;
    double cell_m_;
    ContourDrawer drawer_;
    StackRmse rmse_;                    // of the contours as traced
    std::vector<StackRmse> cut_rmses_;  // same, of the stacks truncated at level 1, 2, ...
    StackRmse rmse_below_;              // of the levels below the current one
    std::optional<DrawnStack> stack_;   // set if drawn outlines differ from traced ones
    std::int64_t next_id_ = 1;
    std::int64_t next_building_ = 1;
    std::int64_t next_face_ = 1;
    std::unordered_map<std::int64_t, std::int64_t> first_parts_;  // lowest id of the parts of a whole
    std::optional<RejectedLayer> rejected_;
    std::optional<RoofLayer> roofs_;
    std::optional<RoundedPolygons> rounded_;  // set if the destination rounds coordinates
    InvalidWarnings invalid_;
    ImplausibleHeights implausible_heights_;
    ProjectionSplitWarnings split_warnings_;
};

}  // namespace d2b::features
