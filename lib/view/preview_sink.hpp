#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "dem2buildings/sinks.hpp"
#include "view/map_picture.hpp"
#include "write/staging.hpp"

namespace d2b::view {

/// Outlines of the first of several maps, so that differences from it can be marked on the others.
class FirstOutlines {
  public:
    using Rings = std::vector<std::vector<PixelPoint>>;
    struct Outline {
        std::size_t layer = 0;
        Rings rings;
        bool seen = false;
    };

    /// Returns true once the first map is complete.
    [[nodiscard]] bool is_complete() const { return complete_; }
    void complete() { complete_ = true; }
    void add(std::size_t layer, Rings rings);
    /// Marks an outline as seen on the present map. Returns false if the first map does not have it.
    [[nodiscard]] bool find(std::size_t layer, const Rings& rings);
    /// Returns the outlines that were not seen, and forgets which were.
    [[nodiscard]] std::vector<Outline> take_missing();

  private:
    std::map<std::string, Outline> outlines_;  ///< by layer and coordinates
    bool complete_ = false;
};

/// Passes features on to another sink and draws them over the relief: buildings coloured by height, and their
/// contours as lines. If no buildings are written, contours are coloured instead, from low to high.
///
/// Elevations and features may arrive in any interleaving: write elevations to relief(), features to this
/// sink, and receive the finished map in `on_map`.
class PreviewSink final : public writing::FileSink<FeatureSink> {
  public:
    /// Receives the map.
    using OnMap = std::function<void(MapPicture map)>;

    /// @param features must outlive this @param on_map called in finish() or prepare(), before those of
    /// `features` @param first outlines of the first of several maps in the same frame; nullptr for one map
    PreviewSink(FeatureSink& features, const MapFrame& frame, writing::PictureFormat format, OnMap on_map,
                std::shared_ptr<FirstOutlines> first = nullptr);

    /// Returns the sink for the elevations, which must be complete before finish().
    [[nodiscard]] RasterSink& relief() { return *relief_; }

    void require_crs(const std::string& wkt, const std::string& name, const Position& place) override {
        features_.require_crs(wkt, name, place);
    }
    void preflight(std::span<const LayerSpec> layers, const Provenance& provenance,
                   const Position& place) override {
        features_.preflight(layers, provenance, place);
    }
    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    [[nodiscard]] CoordinateRounding rounding() const override { return features_.rounding(); }
    void take_report(const RunReport& report) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return features_.take_warnings(); }
    [[nodiscard]] std::int64_t first_id() const override { return features_.first_id(); }
    [[nodiscard]] bool takes_points() const override { return features_.takes_points(); }
    [[nodiscard]] Layers layers(std::optional<Layers> asked) const override {
        return features_.layers(asked);
    }
    [[nodiscard]] std::string layer_name(LayerRole role, Layers layers) const override {
        return features_.layer_name(role, layers);
    }

  private:
    /// Layer to be drawn.
    struct DrawnLayer {
        std::size_t layer = 0;
        std::size_t height = 0;  ///< index of the height field
        std::optional<std::size_t> certainty = {};
        double certain = 1;
    };
    /// Returns the colour of a feature; nullopt if it has no height.
    [[nodiscard]] std::optional<Colour> colour_of(const Feature& feature, const DrawnLayer& drawn);
    void draw(const WorldPolygon& polygon, const DrawnLayer& drawn, Colour colour);
    void compare(std::size_t layer, const FirstOutlines::Rings& rings);
    /// Marks differences from the first map, above everything else.
    void mark_differences();

    FeatureSink& features_;
    OnMap on_map_;
    std::shared_ptr<FirstOutlines> first_;
    std::vector<FirstOutlines::Outline> added_;  ///< that the first map does not have
    std::shared_ptr<Relief> relief_;
    MapPicture map_;
    std::optional<CoordinateTransform> to_dem_;  ///< set if the features are in another CRS
    std::optional<DrawnLayer> filled_layer_;
    std::optional<DrawnLayer> stroked_layer_;
};

}  // namespace d2b::view
