#include "read/polygon_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>

#include <gdal_alg.h>

#include "core/number_from_chars.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {
namespace {

/// Returns the index of the height field, or -1.
int pick_height(OGRLayerH layer, const LayerChoice& choice) {
    const OGRFeatureDefnH schema = OGR_L_GetLayerDefn(layer);
    if (choice.height_field.empty()) {
        for (const std::string& name : choice.default_heights)
            if (const int field = OGR_FD_GetFieldIndex(schema, name.c_str()); field >= 0)
                return field;
        return -1;
    }
    const int field = OGR_FD_GetFieldIndex(schema, choice.height_field.c_str());
    if (field >= 0)
        return field;
    refuse_missing_field(layer, choice.dataset, choice.height_field);
}

/// Returns the height of a feature. Texts count if they are numbers throughout, because heights of
/// OpenStreetMap are stored as texts.
std::optional<double> height_of(OGRFeatureH feature, int field) {
    if (field < 0 || OGR_F_IsFieldSetAndNotNull(feature, field) == FALSE)
        return std::nullopt;
    const OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field));
    const bool is_number = type == OFTInteger || type == OFTInteger64 || type == OFTReal;
    const std::optional<double> value = is_number
                                            ? OGR_F_GetFieldAsDouble(feature, field)
                                            : parse_number<double>(OGR_F_GetFieldAsString(feature, field));
    return value && std::isfinite(*value) ? value : std::nullopt;
}

struct CellMask {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::vector<std::uint8_t> valid;  ///< 1 or 0
};

CellMask mask_of(DemSource& dem) {
    constexpr std::int32_t values_at_once = 1 << 20;
    const DemInfo& info = dem.info();
    CellMask mask{info.rows, info.cols, {}};
    mask.valid.reserve(static_cast<std::size_t>(info.rows) * static_cast<std::size_t>(info.cols));
    const std::int32_t rows_at_once = std::max(1, values_at_once / info.cols);
    std::vector<double> values;
    for (std::int32_t row = 0; row < info.rows; row += rows_at_once) {
        const Window part{row, 0, std::min(rows_at_once, info.rows - row), info.cols};
        values.resize(static_cast<std::size_t>(part.points()));
        dem.read(part, values);
        for (const double value : values)
            mask.valid.push_back(std::isnan(value) ? 0 : 1);
    }
    return mask;
}

/// Returns the driver of vectors in memory, because GDAL 3.11 merges it into MEM.
GDALDriverH memory_driver() {
    const GDALDriverH driver = GDALGetDriverByName("Memory");
    return driver != nullptr ? driver : GDALGetDriverByName("MEM");
}

/// Outlines the mask in columns and, downwards, rows.
std::vector<WorldPolygon> polygons_of(CellMask& mask, const std::string& name) {
    const GdalMessages messages;
    const DatasetOwner raster(
        GDALCreate(GDALGetDriverByName("MEM"), "", mask.cols, mask.rows, 1, GDT_Byte, nullptr));
    const DatasetOwner vectors(GDALCreate(memory_driver(), "", 0, 0, 0, GDT_Unknown, nullptr));
    const OGRLayerH layer =
        vectors ? GDALDatasetCreateLayer(vectors.get(), "valid", nullptr, wkbPolygon, nullptr) : nullptr;
    const GDALRasterBandH band = raster ? GDALGetRasterBand(raster.get(), 1) : nullptr;
    if (band == nullptr || layer == nullptr ||
        GDALRasterIO(band, GF_Write, 0, 0, mask.cols, mask.rows, mask.valid.data(), mask.cols, mask.rows,
                     GDT_Byte, 0, 0) != CE_None ||
        GDALPolygonize(band, band, layer, -1, nullptr, nullptr, nullptr) != CE_None)
        throw InputError("The cells of '" + name +
                         "' that have data cannot be outlined: " + messages.reason() + ".");
    std::vector<WorldPolygon> polygons;
    OGR_L_ResetReading(layer);
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        for (WorldPolygon& polygon : polygon_feature_of(OGR_F_GetGeometryRef(feature.get())).polygons)
            polygons.push_back(std::move(polygon));
    return polygons;
}

void place(WorldRing& ring, const AffineTransform& g) {
    for (Position& p : ring)
        p = {g[0] + p.x * g[1] + p.y * g[2], g[3] + p.x * g[4] + p.y * g[5]};
}

}  // namespace

std::vector<std::string> layer_names(const std::string& dataset, Warnings& warnings) {
    const NetworkGuard gate(dataset);
    return geometry_layers(open_polygons(dataset, warnings).get());
}

PolygonLayer read_polygon_layer(const LayerChoice& choice, Warnings& warnings) {
    const NetworkGuard gate(choice.dataset);
    const DatasetOwner dataset = open_polygons(choice.dataset, warnings);
    const OGRLayerH layer = pick_layer(dataset.get(), choice);
    const int height = pick_height(layer, choice);
    PolygonLayer result{choice.dataset, OGR_L_GetName(layer), wkt_of(OGR_L_GetSpatialRef(layer)), {}, {}};
    if (height >= 0)
        result.height_field = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), height));
    for_each_polygon_feature(layer, choice.dataset, warnings,
                             [&](OGRFeatureH feature, OGRGeometryH geometry) {
                                 PolygonFeature found = polygon_feature_of(geometry);
                                 if (found.polygons.empty())
                                     return false;
                                 found.height = height_of(feature, height);
                                 result.features.push_back(std::move(found));
                                 return true;
                             });
    return result;
}

ValidCells valid_cells(const std::string& path, Warnings& warnings) {
    ReadOptions options;
    options.source = path;
    std::vector<std::string> heard;  // kept back, because a missing CRS would give advice for another tool
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) { heard.push_back(text); };
    const std::unique_ptr<DemSource> dem = open_dem(options, callbacks);
    CellMask mask = mask_of(*dem);
    std::ranges::copy(dem->take_warnings(), std::back_inserter(heard));
    const auto count = std::ranges::count(mask.valid, std::uint8_t{1});
    if (count == 0)
        throw InputError("No cell of '" + path +
                         "' has data; give the raster that the footprints come from.");
    const DemInfo& info = dem->info();
    if (info.crs_wkt.empty())
        warnings.add("'" + path +
                     "' has no coordinate reference system; its coordinates are taken as the reference's.");
    else
        for (const std::string& text : heard)
            warnings.add(text);
    const double cols = info.cols;
    const double rows = info.rows;
    const double col = std::floor(cols / 2);
    const double row = std::floor(rows / 2);
    ValidCells result{{}, info.crs_wkt, {{col, row}, {col + 1, row}, {col + 1, row + 1}, {col, row + 1}}};
    if (static_cast<std::size_t>(count) == mask.valid.size())
        result.polygons = {{{{0, 0}, {cols, 0}, {cols, rows}, {0, rows}}, {}}};
    else
        result.polygons = polygons_of(mask, path);
    for (WorldPolygon& polygon : result.polygons) {
        place(polygon.exterior, info.transform);
        for (WorldRing& ring : polygon.interiors)
            place(ring, info.transform);
    }
    place(result.middle_cell, info.transform);
    return result;
}

bool is_vector_dataset(const std::string& path) {
    const NetworkGuard gate(path);
    const GdalMessages quiet;
    const DatasetOwner dataset = open_guarded(path, GDAL_OF_VECTOR | GDAL_OF_READONLY);
    return dataset && !geometry_layers(dataset.get()).empty();
}

}  // namespace d2b::reading
