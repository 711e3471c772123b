#include "read/correction_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "raster/row_spans.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/ring_projection.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {
namespace {

constexpr const char* kind_field = "kind";

PolygonSource source_of(const CorrectionChoice& choice) {
    return {"correction dataset", "corrections_layer", choice.dataset, choice.layer};
}

/// Counts features of one fault and names the first few.
class FaultyFeatures {
  public:
    void add(const std::string& text) {
        constexpr std::int64_t most_named = 5;
        if (++count_ <= most_named)
            names_ += (names_.empty() ? "" : ", ") + text;
        else if (count_ == most_named + 1)
            names_ += " and others";
    }
    [[nodiscard]] std::int64_t count() const { return count_; }
    void warn(const std::string& of, const std::string& fault, Warnings& warnings) const {
        if (count_ > 0)
            warnings.add("The " + of + " has features " + fault + ": " + std::to_string(count_) + ", " +
                         names_ + ".");
    }

  private:
    std::int64_t count_ = 0;
    std::string names_;
};

class CorrectionReader final : public CorrectionSource {
  public:
    CorrectionReader(const CorrectionChoice& choice, const DemInfo& grid, const Callbacks& callbacks);

    [[nodiscard]] const std::vector<Correction>& corrections() const override { return all_; }
    [[nodiscard]] std::int64_t unusable() const override { return unknown_.count() + unsuited_.count(); }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return warnings_.take(); }

  private:
    [[nodiscard]] std::vector<OGRLayerH> layers(GDALDatasetH dataset);
    void read(OGRLayerH layer, const DemInfo& grid, bool named);
    void add(Correction&& correction, OGRGeometryH geometry, RingProjector& projector);
    void add_polygon(OGRGeometryH polygon, RingProjector& projector, Correction& correction) const;
    void add_line(OGRGeometryH line, RingProjector& projector, Correction& correction) const;
    void add_point(OGRGeometryH point, RingProjector& projector, Correction& correction) const;

    PolygonSource source_;
    Warnings warnings_;
    Window window_;
    std::vector<Correction> all_;
    FaultyFeatures unknown_;
    FaultyFeatures unsuited_;
};

CorrectionReader::CorrectionReader(const CorrectionChoice& choice, const DemInfo& grid,
                                   const Callbacks& callbacks)
    : source_(source_of(choice)), warnings_(callbacks.on_warning), window_(grid.window) {
    const NetworkGuard gate(source_.path);
    const DatasetOwner dataset = open_source(source_, warnings_);
    const std::vector<OGRLayerH> all = layers(dataset.get());
    for (OGRLayerH const layer : all)
        read(layer, grid, all.size() > 1);
    unknown_.warn(source_.name(),
                  "whose kind is not 'building', 'no building' or 'cut', and which are ignored", warnings_);
    unsuited_.warn(source_.name(),
                   "whose geometry does not suit their kind (a cut is a line, the others are points or "
                   "polygons), and which are ignored",
                   warnings_);
    warnings_.hold();
}

/// Layers of an editor have one type of geometry each, so by default all of them are read.
std::vector<OGRLayerH> CorrectionReader::layers(GDALDatasetH dataset) {
    const auto has_kind = [](OGRLayerH layer) {
        return OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), kind_field) >= 0;
    };
    if (!source_.layer.empty()) {
        OGRLayerH const layer = layer_of(dataset, source_, warnings_);
        if (!has_kind(layer))
            throw OptionError("The layer '" + source_.layer + "' of the " + source_.name() +
                              " has no field 'kind'; " + field_list(layer));
        return {layer};
    }
    std::vector<OGRLayerH> found;
    for (const std::string& name : geometry_layers(dataset))
        if (OGRLayerH const layer = GDALDatasetGetLayerByName(dataset, name.c_str()); has_kind(layer))
            found.push_back(layer);
    if (found.empty())
        throw InputError("No layer of the " + source_.name() +
                         " has geometries and a field 'kind'; add that field, with the words 'building', 'no "
                         "building' or 'cut'.");
    return found;
}

std::string word_of(CorrectionKind kind) {
    return std::string(correction_names[static_cast<std::size_t>(kind)]);
}

/// @return nothing if the feature has no kind that is known
std::optional<CorrectionKind> kind_of(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos)
        return std::nullopt;
    const std::string word = to_lower(text.substr(first, text.find_last_not_of(' ') - first + 1));
    const auto known = std::ranges::find(correction_names, word);
    if (known == correction_names.end())
        return std::nullopt;
    return static_cast<CorrectionKind>(known - correction_names.begin());
}

void CorrectionReader::read(OGRLayerH layer, const DemInfo& grid, bool named) {
    const TransformOwner to_dem = transform_to_dem(OGR_L_GetSpatialRef(layer), source_, grid, warnings_);
    RingProjector projector(to_dem.get(), grid.transform, source_.name());
    const int field = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), kind_field);
    for_each_geometry(
        layer, "The " + source_.name(), warnings_, [&](OGRFeatureH feature, OGRGeometryH geometry) {
            Correction correction;
            correction.name = "feature " + std::to_string(OGR_F_GetFID(feature)) +
                              (named ? " of '" + std::string(OGR_L_GetName(layer)) + "'" : "");
            const bool has_text = OGR_F_IsFieldSetAndNotNull(feature, field) != FALSE;
            const std::string text = has_text ? utf8_text(OGR_F_GetFieldAsString(feature, field)) : "";
            const std::optional<CorrectionKind> kind = kind_of(text);
            if (!kind) {
                unknown_.add(correction.name + (has_text ? " ('" + text + "')" : " (NULL)"));
                return;
            }
            correction.kind = *kind;
            add(std::move(correction), geometry, projector);
        });
}

void CorrectionReader::add(Correction&& correction, OGRGeometryH geometry, RingProjector& projector) {
    const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
    std::vector<OGRGeometryH> polygons;
    std::vector<OGRGeometryH> lines;
    std::vector<OGRGeometryH> points;
    if (straight && correction.kind == CorrectionKind::cut) {
        lines = lines_within(straight.get());
    } else if (straight) {
        polygons = polygons_within(straight.get());
        points = points_within(straight.get());
    }
    if (polygons.empty() && lines.empty() && points.empty()) {
        unsuited_.add(correction.name + " ('" + word_of(correction.kind) + "')");
        return;
    }
    correction.is_point = polygons.empty() && lines.empty();
    for (OGRGeometryH const polygon : polygons)
        add_polygon(polygon, projector, correction);
    for (OGRGeometryH const line : lines)
        add_line(line, projector, correction);
    if (correction.is_point)
        for (OGRGeometryH const point : points)
            add_point(point, projector, correction);
    all_.push_back(std::move(correction));
}

void CorrectionReader::add_polygon(OGRGeometryH polygon, RingProjector& projector,
                                   Correction& correction) const {
    std::vector<WorldRing> rings = rings_of(polygon);
    for (WorldRing& ring : rings)
        ring = projector.project(ring);
    for (const RowSpan& span : row_spans(rings, window_))
        correction.cells.push_back({span.row, span.begin, span.end});
}

void CorrectionReader::add_line(OGRGeometryH line, RingProjector& projector, Correction& correction) const {
    const IndexRange rows{window_.row, window_.end_row()};
    const IndexRange cols{window_.col, window_.end_col()};
    const WorldRing path = projector.project(points_of(line));
    for (std::size_t i = 1; i < path.size(); ++i)
        for_each_cut(path[i - 1], path[i], rows, cols, [&](std::int32_t row, std::int32_t col, bool below) {
            correction.cuts.push_back({row, col, below});
        });
}

void CorrectionReader::add_point(OGRGeometryH point, RingProjector& projector, Correction& correction) const {
    const Position at =
        projector.project(WorldRing{Position{OGR_G_GetX(point, 0), OGR_G_GetY(point, 0)}}).front();
    const double row = std::floor(at.y);
    const double col = std::floor(at.x);
    if (row >= window_.row && row < window_.end_row() && col >= window_.col && col < window_.end_col())
        correction.cells.push_back({static_cast<std::int32_t>(row), static_cast<std::int32_t>(col),
                                    static_cast<std::int32_t>(col) + 1});
}

}  // namespace

std::unique_ptr<CorrectionSource> open_corrections(const CorrectionChoice& choice, const DemInfo& grid,
                                                   const Callbacks& callbacks) {
    return std::make_unique<CorrectionReader>(choice, grid, callbacks);
}

}  // namespace d2b::reading
