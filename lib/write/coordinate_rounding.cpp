#include "write/coordinate_rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <cpl_conv.h>

#include "dem2buildings/error.hpp"
#include "features/rounded_polygons.hpp"
#include "read/config_option.hpp"
#include "read/polygon_geometry.hpp"
#include "write/dataset_writer.hpp"
#include "write/trial_dataset.hpp"

namespace d2b {

namespace {

/// Distinct values per axis: independent of the orientation and start of a ring, which drivers may change.
struct AxisValues {
    std::set<double> x;
    std::set<double> y;

    void add(const Position& p) {
        x.insert(p.x);
        y.insert(p.y);
    }
    friend bool operator==(const AxisValues&, const AxisValues&) = default;
};

/// Ring around a position with all digits of a double; no two vertices share a coordinate.
WorldRing trial_ring(const Position& place) {
    constexpr std::size_t corners = 12;
    constexpr double irrational = 0.6180339887498949;
    const double size = 1e-3 * std::max({std::abs(place.x), std::abs(place.y), 1.0});
    WorldRing ring;
    for (std::size_t i = 0; i < corners; ++i) {
        const double turn = 2 * 3.141592653589793 * (static_cast<double>(i) + irrational) / corners;
        ring.push_back({place.x + size * std::cos(turn), place.y + size * std::sin(turn)});
    }
    return ring;
}

AxisValues values_of(const WorldRing& ring, const CoordinateRounding& rounding) {
    AxisValues values;
    for (const Position& p : ring)
        values.add({rounded(p.x, rounding), rounded(p.y, rounding)});
    return values;
}

AxisValues read_back(const VectorFormat& format, const std::string& file) {
    AxisValues values;
    const DatasetOwner dataset = open_dataset(format, file, GDAL_OF_READONLY);
    OGRLayerH layer = dataset ? GDALDatasetGetLayer(dataset.get(), 0) : nullptr;
    const FeatureOwner feature(layer == nullptr ? nullptr : OGR_L_GetNextFeature(layer));
    OGRGeometryH geometry = feature ? OGR_F_GetGeometryRef(feature.get()) : nullptr;
    if (geometry == nullptr)
        return values;
    for (const WorldPolygon& polygon : polygon_feature_of(geometry).polygons)
        for (const Position& p : polygon.exterior)
            values.add(p);
    return values;
}

/// Names the option that causes the rounding, for messages.
std::string cause_of(const Draft& draft, bool appends) {
    if (!appends)
        for (const std::string& option : draft.options.layer_options)
            for (const char* key : {"PRECISION", "SIGNIFICANT_FIGURES", "RFC7946"})
                if (option.substr(0, option.find('=')).find(key) != std::string::npos)
                    return "-lco " + option;
    for (const char* key : {"OGR_WKT_PRECISION", "OGR_WKT_ROUND"})
        if (const char* value = CPLGetConfigOption(key, nullptr);
            value != nullptr && draft.format.name == "CSV")
            return "The configuration option " + std::string(key) + "=" + value;
    return "The format " + draft.format.name;
}

void write_trial(const std::string& file, const std::string& folder, const Draft& draft, bool appends,
                 const WorldRing& ring) {
    WriteOptions options = draft.options;
    if (appends)  // layer options do not affect existing layers
        options.layer_options.clear();
    LayerSpec layer = draft.layers.front();
    layer.with_arcs = false;
    DatasetWriter writer({draft.destination.name, folder}, draft.format, options);
    writer.begin(file, DatasetWriter::Mode::create, std::span(&layer, 1), draft.provenance);
    writer.add(0, {std::vector<FieldValue>(layer.fields.size()), {{ring, {}}}});
    writer.close();
}

}  // namespace

std::optional<CoordinateRounding> coordinate_rounding(const Draft& draft, bool appends) {
    using To = CoordinateRounding::To;
    if (!keeps_virtual_files(draft.format.driver) || draft.layers.empty() || draft.layers.front().points ||
        !std::isfinite(draft.place.x + draft.place.y))
        return CoordinateRounding{};
    const GdalMessages quiet;
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    const MemoryFolder memory;
    const std::string file = memory.file(trial_name(draft.format.driver, draft.destination.path));
    const WorldRing ring = trial_ring(draft.place);
    try {
        write_trial(file, memory.file(""), draft, appends, ring);
    } catch (const Error&) {
        return CoordinateRounding{};  // preflight reports the reason
    }
    const AxisValues there = read_back(draft.format, file);
    if (there.x.empty() || there == values_of(ring, {}))
        return CoordinateRounding{};
    for (const To to : {To::decimals, To::significant_digits})
        for (int digits = to == To::decimals ? 0 : 1; digits <= 17; ++digits)
            if (const CoordinateRounding rounding{to, digits}; there == values_of(ring, rounding))
                return CoordinateRounding{to, digits, cause_of(draft, appends)};
    return std::nullopt;
}

void warn_of_invalid(const WriteTarget& target, const VectorFormat& format, const std::string& path) {
    const GdalMessages quiet;
    const DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    for (int i = 0; dataset && i < GDALDatasetGetLayerCount(dataset.get()); ++i) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), i);
        std::int64_t invalid = 0;
        OGR_L_ResetReading(layer);
        while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
            if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
                geometry != nullptr && OGR_G_IsValid(geometry) == FALSE)
                ++invalid;
        target.stop.check();
        if (invalid > 0 && target.warnings != nullptr)
            target.warnings->add(std::to_string(invalid) +
                                 (invalid == 1 ? " polygon of layer \"" : " polygons of layer \"") +
                                 OGR_L_GetName(layer) + "\" of \"" + target.name +
                                 (invalid == 1 ? "\" is" : "\" are") + " not valid as " + format.name +
                                 " keeps coordinates; write another format, such as GeoPackage.");
    }
}

}  // namespace d2b
