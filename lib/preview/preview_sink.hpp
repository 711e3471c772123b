#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/feature_sink.hpp"
#include "preview/canvas.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// How a preview looks.
struct PreviewLook {
    int longest = 1200;          ///< side of the map, in pixels
    std::string heading;         ///< before the counts; what was tried
    double vertical_metres = 1;  ///< metres in a unit of elevation
};

/// Hands features on to another sink and draws them over the shaded relief: the contours from low to high, or
/// the buildings where no contours are written, in the colours of their heights.
class PreviewSink final : public FeatureSink {
  public:
    /// Takes a picture. @param image heading and counts below the map
    using Taken = std::function<void(const Image& image)>;

    /// @param features must outlive this, as must the DEM @param crs of the DEM @param taken
    /// called in finish(), before the features' own
    PreviewSink(FeatureSink& features, DemSource& dem, Crs crs, PreviewLook look, Taken taken);

    void require_crs(const std::string& wkt, const std::string& name, const Position& place) override {
        features_.require_crs(wkt, name, place);
    }
    void rehearse(std::span<const LayerSpec> layers, const Provenance& provenance,
                  const Position& place) override {
        features_.rehearse(layers, provenance, place);
    }
    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void take_report(const RunReport& report) override;
    void finish() override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return features_.take_warnings(); }
    [[nodiscard]] std::int64_t first_id() const override { return features_.first_id(); }
    [[nodiscard]] Layers layers(std::optional<Layers> asked) const override {
        return features_.layers(asked);
    }
    [[nodiscard]] std::string layer_name(LayerRole role, Layers layers) const override {
        return features_.layer_name(role, layers);
    }

  private:
    void draw(const WorldPolygon& polygon, Colour colour);
    void write_caption(const RunReport& report);

    FeatureSink& features_;
    DemSource& dem_;
    Crs crs_;
    PreviewLook look_;
    Taken taken_;
    MapFrame frame_;
    Canvas canvas_;
    std::optional<CoordinateTransform> to_dem_;  ///< where the features are in another CRS
    std::size_t layer_ = 0;                      ///< that is drawn
    std::size_t height_ = 0;                     ///< its field of heights
};

}  // namespace d2b
