#include "read/footprint_reader.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/original_layer.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {
namespace {

PolygonSource footprints_of(const FootprintChoice& choice) {
    return {"footprint dataset", "footprints_layer", choice.dataset, choice.layer};
}

/// @return null if both are the same @throws InputError if there is no operation between them
TransformOwner transform_between(const std::string& from, const std::string& to,
                                 const PolygonSource& source) {
    const GdalMessages messages;
    const CrsOwner own = horizontal_crs(from);
    const CrsOwner target = horizontal_crs(to);
    if (own == nullptr || target == nullptr || OSRIsSame(own.get(), target.get()) != FALSE)
        return nullptr;
    TransformOwner transform(OCTNewCoordinateTransformation(own.get(), target.get()));
    if (!transform)
        throw InputError("The " + source.name() + " cannot be converted to the CRS of -t_srs: " +
                         messages.reason() + "; choose another one.");
    return transform;
}

class FootprintReader final : public FootprintSource {
  public:
    FootprintReader(const FootprintChoice& choice, const DemInfo& dem, const Callbacks& callbacks);

    [[nodiscard]] std::string crs_wkt() const override { return crs_wkt_; }
    [[nodiscard]] std::shared_ptr<const OriginalLayer> layer() const override { return original_; }
    void for_each(const std::function<void(GivenFootprint&&)>& use) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return warnings_.take(); }

  private:
    [[nodiscard]] GivenFootprint footprint_of(OGRFeatureH feature) const;
    [[nodiscard]] GeometryOwner in_target_crs(OGRFeatureH feature, OGRGeometryH geometry) const;

    PolygonSource source_;
    Warnings warnings_;
    std::optional<NetworkGuard> gate_;  ///< active during construction
    DatasetOwner dataset_;
    OGRLayerH layer_;
    std::shared_ptr<const OgrOriginalLayer> original_;
    std::string crs_wkt_;
    TransformOwner to_target_;
};

FootprintReader::FootprintReader(const FootprintChoice& choice, const DemInfo& dem,
                                 const Callbacks& callbacks)
    : source_(footprints_of(choice)),
      warnings_(callbacks.on_warning),
      gate_(std::in_place, source_.path),
      dataset_(open_source(source_, warnings_)),
      layer_(layer_of(dataset_.get(), source_, warnings_)),
      original_(std::make_shared<const OgrOriginalLayer>(layer_)),
      crs_wkt_(wkt_of(OGR_L_GetSpatialRef(layer_))) {
    // Checks that the CRSs fit; the polygons are projected later, from repaired copies.
    if (!transform_to_dem(OGR_L_GetSpatialRef(layer_), source_, dem, warnings_))
        crs_wkt_.clear();  // the same as that of the DEM
    if (!choice.target_crs.empty())
        to_target_ = transform_between(crs_wkt_.empty() ? dem.crs_wkt : crs_wkt_, choice.target_crs, source_);
    const GdalMessages messages;
    OGR_L_ResetReading(layer_);
    const FeatureOwner first{OGR_L_GetNextFeature(layer_)};
    if (messages.failed())
        throw InputError("The " + source_.name() + " cannot be read: " + messages.reason() + ".");
    if (!first)
        throw InputError("The layer '" + std::string(OGR_L_GetName(layer_)) + "' of the " + source_.name() +
                         " has no features; give a layer with footprints.");
    warnings_.hold();
    gate_.reset();
}

GeometryOwner FootprintReader::in_target_crs(OGRFeatureH feature, OGRGeometryH geometry) const {
    GeometryOwner moved(OGR_G_Clone(geometry));
    const GdalMessages messages;
    if (OGR_G_Transform(moved.get(), to_target_.get()) != OGRERR_NONE)
        throw InputError("Feature " + std::to_string(OGR_F_GetFID(feature)) + " of the " + source_.name() +
                         " cannot be converted to the CRS of -t_srs: " + messages.reason() +
                         "; choose one that suits all footprints.");
    return moved;
}

GivenFootprint FootprintReader::footprint_of(OGRFeatureH feature) const {
    GivenFootprint footprint;
    footprint.fid = OGR_F_GetFID(feature);
    OGRGeometryH const geometry = OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr) {
        footprint.original = original_->encode(feature, nullptr);
        return footprint;
    }
    footprint.polygons = polygon_feature_of(geometry).polygons;
    if (!to_target_) {
        footprint.original = original_->encode(feature, geometry);
        return footprint;
    }
    const GeometryOwner moved = in_target_crs(feature, geometry);
    footprint.projected = polygon_feature_of(moved.get()).polygons;
    footprint.original = original_->encode(feature, moved.get());
    return footprint;
}

void FootprintReader::for_each(const std::function<void(GivenFootprint&&)>& use) {
    {
        const NetworkGuard gate(dataset_.get());
        const GdalMessages messages;
        OGR_L_ResetReading(layer_);
        while (const FeatureOwner feature{OGR_L_GetNextFeature(layer_)})
            use(footprint_of(feature.get()));
        if (messages.failed())
            throw InputError("The " + source_.name() + " cannot be read: " + messages.reason() + ".");
        messages.pass_warnings(warnings_);
    }
    to_target_.reset();
    layer_ = nullptr;
    dataset_.reset();
}

}  // namespace

std::unique_ptr<FootprintSource> open_footprints(const FootprintChoice& choice, const DemInfo& dem,
                                                 const Callbacks& callbacks) {
    return std::make_unique<FootprintReader>(choice, dem, callbacks);
}

}  // namespace d2b::reading
