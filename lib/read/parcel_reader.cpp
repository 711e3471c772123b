#include "read/parcel_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "raster/row_spans.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/ring_projection.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {
namespace {

class Burner {
  public:
    Burner(const Window& part, std::span<ParcelCell> cells)
        : part_(part), rows_{part.row, part.end_row()}, cols_{part.col, part.end_col()}, cells_(cells) {}

    void fill(const std::vector<WorldRing>& rings, const PixelParcel& parcel);
    void draw(const WorldRing& line);

  private:
    [[nodiscard]] ParcelCell& cell(std::int32_t row, std::int32_t col) {
        return cells_[static_cast<std::size_t>(row - part_.row) * static_cast<std::size_t>(part_.cols) +
                      static_cast<std::size_t>(col - part_.col)];
    }

    Window part_;
    IndexRange rows_;
    IndexRange cols_;
    std::span<ParcelCell> cells_;
};

void Burner::fill(const std::vector<WorldRing>& rings, const PixelParcel& parcel) {
    for (const RowSpan& span : row_spans(rings, part_))
        for (std::int32_t col = span.begin; col < span.end; ++col) {
            ParcelCell& here = cell(span.row, col);
            if (here.parcel != ParcelCell::no_parcel && here.parcel != parcel.number) {
                here.several = true;
                continue;
            }
            here.parcel = parcel.number;
            here.invalid = !parcel.valid;
        }
}

void Burner::draw(const WorldRing& line) {
    for (std::size_t i = 1; i < line.size(); ++i)
        for_each_cut(line[i - 1], line[i], rows_, cols_, [&](std::int32_t row, std::int32_t col, bool below) {
            (below ? cell(row, col).cut_below : cell(row, col).cut_right) = true;
        });
}

constexpr double margin_cells = 4;
constexpr double margin_share = 0.05;  // of a part, because straight edges become curves in another CRS

PolygonSource source_of(const ParcelChoice& choice) {
    return {"parcel dataset", "split_layer", choice.dataset, choice.layer};
}

/// @return -1 for the feature id
int field_of(OGRLayerH layer, const ParcelChoice& choice) {
    if (choice.field.empty())
        return -1;
    const int field = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), choice.field.c_str());
    if (field >= 0)
        return field;
    throw OptionError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of the " +
                      source_of(choice).name() + " has no field '" + choice.field + "' for -split_field; " +
                      field_list(layer));
}

/// Returns the envelope of a part of a DEM in the CRS of the layer. @param back transformation to that CRS,
/// or null @return nothing if a point cannot be transformed
std::optional<ClipBox> box_around(const Window& part, const AffineTransform& grid,
                                  OGRCoordinateTransformationH back) {
    const std::optional<WorldRing> places = lattice_over(part, margin_cells, grid, back);
    if (!places)
        return std::nullopt;
    const ClipBox box = box_of({&*places, 1});
    const double x = back != nullptr ? margin_share * (box.right - box.left) : 0;
    const double y = back != nullptr ? margin_share * (box.top - box.bottom) : 0;
    return ClipBox{box.left - x, box.bottom - y, box.right + x, box.top + y};
}

class ParcelReader final : public ParcelSource {
  public:
    ParcelReader(const ParcelChoice& choice, const DemInfo& grid, const Callbacks& callbacks);

    void read(const Window& part, std::span<ParcelCell> cells) override;
    [[nodiscard]] std::string_view name(std::int64_t parcel) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return warnings_.take(); }

  private:
    void filter_by(const Window& part);
    void require_some(const DemInfo& grid);
    [[nodiscard]] PixelParcel parcel_of(OGRFeatureH feature, OGRGeometryH geometry);
    [[nodiscard]] std::string text_of(OGRFeatureH feature) const;

    PolygonSource source_;
    Warnings warnings_;
    AffineTransform grid_;
    std::optional<NetworkGuard> gate_;  ///< active during construction
    DatasetOwner dataset_;
    OGRLayerH layer_;
    int field_;
    TransformOwner to_dem_;
    TransformOwner back_;
    std::optional<RingProjector> projector_;
    std::map<std::int64_t, std::string> names_;
};

ParcelReader::ParcelReader(const ParcelChoice& choice, const DemInfo& grid, const Callbacks& callbacks)
    : source_(source_of(choice)),
      warnings_(callbacks.on_warning),
      grid_(grid.transform),
      gate_(std::in_place, source_.path),
      dataset_(open_source(source_, warnings_)),
      layer_(layer_of(dataset_.get(), source_, warnings_)),
      field_(field_of(layer_, choice)) {
    const OGRSpatialReferenceH own = OGR_L_GetSpatialRef(layer_);
    to_dem_ = transform_to_dem(own, source_, grid, warnings_);
    if (to_dem_) {
        const GdalMessages quiet;
        back_.reset(OCTNewCoordinateTransformation(horizontal_crs(grid.crs_wkt).get(), own));
    }
    projector_.emplace(to_dem_.get(), grid_, source_.name());
    require_some(grid);
    warnings_.hold();
    gate_.reset();  // because later reads may come from other threads
}

void ParcelReader::filter_by(const Window& part) {
    const std::optional<ClipBox> box =
        to_dem_ && !back_ ? std::nullopt : box_around(part, grid_, back_.get());
    if (box)
        OGR_L_SetSpatialFilterRect(layer_, box->left, box->bottom, box->right, box->top);
    else
        OGR_L_SetSpatialFilter(layer_, nullptr);
}

void ParcelReader::require_some(const DemInfo& grid) {
    filter_by(grid.window);
    const GdalMessages messages;
    OGR_L_ResetReading(layer_);
    bool any = false;
    while (!any) {
        const FeatureOwner feature{OGR_L_GetNextFeature(layer_)};
        if (!feature)
            break;
        OGRGeometryH const geometry = OGR_F_GetGeometryRef(feature.get());
        any = geometry != nullptr && OGR_G_IsEmpty(geometry) == FALSE && OGR_G_GetDimension(geometry) > 0;
    }
    OGR_L_ResetReading(layer_);  // an open query of SQLite would lock a destination in the same file
    if (messages.failed())
        throw InputError("The " + source_.name() + " cannot be read: " + messages.reason() + ".");
    if (!any)
        throw InputError("The layer '" + std::string(OGR_L_GetName(layer_)) + "' of the " + source_.name() +
                         " has no polygon and no line in the part of '" + grid.name +
                         "' that is used; give the parcels of the same place, or another layer with "
                         "-split_layer.");
}

std::string ParcelReader::text_of(OGRFeatureH feature) const {
    if (field_ < 0)
        return std::to_string(OGR_F_GetFID(feature));
    if (OGR_F_IsFieldSetAndNotNull(feature, field_) == FALSE)
        return {};
    return utf8_text(OGR_F_GetFieldAsString(feature, field_));
}

PixelParcel ParcelReader::parcel_of(OGRFeatureH feature, OGRGeometryH geometry) {
    PixelParcel parcel;
    parcel.number = OGR_F_GetFID(feature);
    const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
    if (!straight)
        return parcel;
    for (OGRGeometryH const polygon : polygons_within(straight.get()))
        for (WorldRing& ring : parcel.polygons.emplace_back(rings_of(polygon)))
            ring = projector_->project(ring);
    for (OGRGeometryH const line : lines_within(straight.get()))
        parcel.lines.push_back(projector_->project(points_of(line)));
    if (!parcel.polygons.empty()) {
        parcel.valid = is_valid(straight.get());
        names_.try_emplace(parcel.number, text_of(feature));
    }
    return parcel;
}

void ParcelReader::read(const Window& part, std::span<ParcelCell> cells) {
    const NetworkGuard gate(dataset_.get());
    std::ranges::fill(cells, ParcelCell());
    filter_by(part);
    std::vector<PixelParcel> parcels;
    for_each_geometry(
        layer_, "The " + source_.name(), warnings_,
        [&](OGRFeatureH feature, OGRGeometryH geometry) { parcels.push_back(parcel_of(feature, geometry)); });
    // Sorts, because a spatial index returns features in any order.
    std::ranges::stable_sort(parcels, {}, &PixelParcel::number);
    for (const PixelParcel& parcel : parcels)
        burn(parcel, part, cells);
}

std::string_view ParcelReader::name(std::int64_t parcel) {
    if (parcel == ParcelCell::no_parcel)
        return {};
    auto known = names_.find(parcel);
    if (known == names_.end()) {
        const GdalMessages messages;
        const NetworkGuard gate(dataset_.get());
        const FeatureOwner feature(OGR_L_GetFeature(layer_, parcel));
        if (!feature)
            throw InputError("Feature " + std::to_string(parcel) + " of the " + source_.name() +
                             " no longer exists: the dataset has changed meanwhile.");
        known = names_.emplace(parcel, text_of(feature.get())).first;
    }
    return known->second;
}

}  // namespace

void burn(const PixelParcel& parcel, const Window& part, std::span<ParcelCell> cells) {
    Burner burner(part, cells);
    for (const std::vector<WorldRing>& rings : parcel.polygons)
        burner.fill(rings, parcel);
    for (const WorldRing& line : parcel.lines)
        burner.draw(line);
}

std::unique_ptr<ParcelSource> open_parcels(const ParcelChoice& choice, const DemInfo& grid,
                                           const Callbacks& callbacks) {
    return std::make_unique<ParcelReader>(choice, grid, callbacks);
}

}  // namespace d2b::reading
