#include "write/vector/preflight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string_view>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"
#include "features/rounded_polygons.hpp"
#include "read/gdal_messages.hpp"
#include "read/vector_layer.hpp"
#include "write/geopackage/dependent_objects.hpp"
#include "write/sql.hpp"
#include "write/staging.hpp"
#include "write/standard_output.hpp"
#include "write/vector/dataset_writer.hpp"
#include "write/vector/layer_writer.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

namespace {

constexpr std::array beginnings{"sqlite_", "gpkg_", "rtree_"};
constexpr std::array reserved_tables{"layer_styles",    "qgis_projects",       "geometry_columns",
                                     "spatial_ref_sys", "spatial_ref_sys_aux", "views_geometry_columns",
                                     "ogr_empty_table", "spatialite_history",  "vector_layers"};

bool is_reserved(const std::string& name) {
    const auto begins = [&](const char* beginning) {
        return EQUALN(name.c_str(), beginning, std::string_view(beginning).size());
    };
    return std::ranges::any_of(beginnings, begins) ||
           std::ranges::any_of(reserved_tables,
                               [&](const char* table) { return EQUAL(name.c_str(), table); });
}

/// Rejects reserved table names and a second column of one name in SQLite databases: GDAL accepts most of the
/// former, and reports the latter as a query that fails.
void reject_reserved_names(const VectorFormat& format, const WriteOptions& options,
                           std::span<const LayerSpec> layers) {
    if (format.name != "GPKG" && format.name != "SQLite")
        return;
    constexpr std::string_view key = "GEOMETRY_NAME=";
    for (const LayerSpec& layer : layers) {
        if (is_reserved(layer.name))
            throw OptionError("-nln: a table \"" + layer.name + "\" of a " + format.name +
                              " file is reserved; choose another name.");
        for (const std::string& option : options.layer_options)
            if (EQUALN(option.c_str(), key.data(), key.size()) &&
                std::ranges::any_of(layer.fields, [&](const FieldSpec& field) {
                    return EQUAL(field.name.c_str(), option.c_str() + key.size());
                }))
                throw OptionError("-lco " + option + " is the name of a field of the layer \"" + layer.name +
                                  "\"; choose another name.");
    }
}

/// Throws if a driver changes field names of a standard, because other programs look for them
/// (case-insensitive).
void reject_changed_names(const PlannedOutput& draft, const DatasetWriter& writer) {
    if (draft.options.fields == FieldNames::own)
        return;
    for (std::size_t i = 0; i < draft.layers.size(); ++i) {
        const std::vector<std::string> columns = writer.columns(i);
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (const std::string& name = draft.layers[i].fields[k].name;
                !EQUAL(columns[k].c_str(), name.c_str()))
                throw OptionError("-fields: \"" + draft.destination.name + "\" would hold a field " +
                                  columns[k] + " instead of " + name +
                                  ", which no other program would find; write a GeoPackage.");
    }
}

/// Returns a small square or a point with a value in every field.
Feature trial_feature(const LayerSpec& layer, const Position& place) {
    Feature feature;
    for (const FieldSpec& field : layer.fields)
        feature.values.push_back(field.type == FieldType::integer ? FieldValue(std::int64_t{1})
                                 : field.type == FieldType::real  ? FieldValue(1.0)
                                                                  : FieldValue(std::string("trial")));
    if (layer.points) {
        feature.place = place;
        return feature;
    }
    const double side = 1e-6 * std::max({std::abs(place.x), std::abs(place.y), 1.0});
    const double right = place.x + side;
    const double top = place.y + side;
    feature.parts = {{{{place.x, place.y}, {right, place.y}, {right, top}, {place.x, top}}, {}}};
    feature.z = 1;
    return feature;
}

/// @param folder with trailing slash @return names of the files in it
std::vector<std::string> create_in(const std::string& folder, const PlannedOutput& draft) {
    const std::string name = std::filesystem::path(draft.destination.path).filename().string();
    const std::string file = folder + (name.empty() ? "trial" : name);
    const WriteTarget target{draft.destination.name, folder};
    DatasetWriter writer(target, draft.format, draft.options);
    writer.begin(file, DatasetWriter::Mode::create, draft.layers, draft.provenance);
    reject_changed_names(draft, writer);
    for (std::size_t i = 0; i < draft.layers.size(); ++i)
        writer.add(i, trial_feature(draft.layers[i], draft.place));
    writer.close();
    std::vector<std::string> names = names_in(folder);
    verify_counts(target, draft.format, file, writer.counts());
    return names;
}

std::string with_advice(std::string sentence, const WriteOptions& options) {
    const bool own =
        options.layer_options.empty() && options.dataset_options.empty() && options.layer_name.empty();
    sentence.pop_back();
    return sentence + (own ? "; write another format, such as GeoPackage."
                           : "; check whether -nln, -lco or -dsco ask for something impossible, or write "
                             "another format, "
                             "such as GeoPackage.");
}

/// Returns the CREATE TABLE statements of new layers.
std::vector<std::string> create_table_statements(const PlannedOutput& draft) {
    const VsimemFolder memory;
    const std::string file = memory.file(probe_name(draft.format.driver, draft.destination.path));
    DatasetWriter writer({draft.destination.name, memory.file("")}, draft.format, draft.options);
    writer.begin(file, DatasetWriter::Mode::create, draft.layers, draft.provenance);
    writer.close();
    const reading::DatasetOwner dataset = open_dataset(draft.format, file, GDAL_OF_READONLY);
    std::vector<std::string> tables;
    for (const LayerSpec& layer : draft.layers)
        if (const auto sql = sql_value(dataset.get(),
                                       "SELECT sql FROM sqlite_master WHERE type = 'table' AND lower(name) "
                                       "= lower(" +
                                           sql_literal(layer.name) + ")"))
            tables.push_back(*sql);
    return tables;
}

/// True if the first feature of a layer was read back at its position.
bool is_at(OGRLayerH layer, const Position& place) {
    constexpr double near = 0.01;
    OGR_L_ResetReading(layer);
    const reading::FeatureOwner feature(OGR_L_GetNextFeature(layer));
    OGRGeometryH geometry = feature ? OGR_F_GetGeometryRef(feature.get()) : nullptr;
    if (geometry == nullptr)
        return false;
    OGREnvelope envelope{};
    OGR_G_GetEnvelope(geometry, &envelope);
    return std::abs(envelope.MinX - place.x) < near && std::abs(envelope.MinY - place.y) < near;
}

bool same_kind(OGRSpatialReferenceH a, OGRSpatialReferenceH b) {
    return OSRIsProjected(a) == OSRIsProjected(b) && OSRIsLocal(a) == OSRIsLocal(b) &&
           OSRIsDerivedGeographic(a) == OSRIsDerivedGeographic(b);
}

/// True if the driver creates a layer in WGS 84; otherwise the CRS is not the reason for its failure.
bool accepts_wgs84(GDALDriverH driver, const std::string& destination) {
    const reading::GdalMessages messages;
    const VsimemFolder memory;
    const reading::DatasetOwner dataset = create_trial(driver, memory.file(probe_name(driver, destination)));
    const reading::CrsOwner srs(OSRNewSpatialReference(nullptr));
    OSRSetWellKnownGeogCS(srs.get(), "WGS84");
    return dataset && add_trial_layer(dataset.get(), "probe", srs.get()) != nullptr && !messages.failed();
}

/// True if the CRS has a WKT 1, to which GDAL exports the CRS of a GeoPackage, reporting an error if it
/// cannot.
bool has_wkt1(OGRSpatialReferenceH srs) {
    const std::array<const char*, 2> options{"FORMAT=WKT1_GDAL", nullptr};
    char* text = nullptr;
    const bool done = OSRExportToWktEx(srs, &text, options.data()) == OGRERR_NONE;
    CPLFree(text);
    return done;
}

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
        values.add({features::rounded(p.x, rounding), features::rounded(p.y, rounding)});
    return values;
}

AxisValues read_back(const VectorFormat& format, const std::string& file) {
    AxisValues values;
    const reading::DatasetOwner dataset = open_dataset(format, file, GDAL_OF_READONLY);
    OGRLayerH layer = dataset ? GDALDatasetGetLayer(dataset.get(), 0) : nullptr;
    const reading::FeatureOwner feature(layer == nullptr ? nullptr : OGR_L_GetNextFeature(layer));
    OGRGeometryH geometry = feature ? OGR_F_GetGeometryRef(feature.get()) : nullptr;
    if (geometry == nullptr)
        return values;
    for (const WorldPolygon& polygon : reading::polygon_feature_of(geometry).polygons)
        for (const Position& p : polygon.exterior)
            values.add(p);
    return values;
}

/// Returns the first layer option whose name contains one of the words, "" if there is none. Options that the
/// driver does not have are left out, because they have no effect, as a warning of GDAL says.
std::string layer_option_with(const PlannedOutput& draft, std::initializer_list<const char*> words) {
    for (const std::string& option : draft.options.layer_options) {
        const std::string name = option.substr(0, option.find('='));
        if (has_layer_option(draft.format.driver, name) && std::ranges::any_of(words, [&](const char* word) {
                return name.find(word) != std::string::npos;
            }))
            return "-lco " + option;
    }
    return {};
}

/// Names the option that causes the rounding, for messages.
std::string cause_of(const PlannedOutput& draft, bool appends) {
    if (!appends)
        if (std::string option = layer_option_with(draft, {"PRECISION", "SIGNIFICANT_FIGURES", "RFC7946"});
            !option.empty())
            return option;
    for (const char* key : {"OGR_WKT_PRECISION", "OGR_WKT_ROUND"})
        if (const char* value = CPLGetConfigOption(key, nullptr);
            value != nullptr && draft.format.name == "CSV")
            return "The configuration option " + std::string(key) + "=" + value;
    return "The format " + draft.format.name;
}

/// Refuses options that round coordinates of another CRS, because polygons cannot be checked in these.
void refuse_rounding_after_conversion(const PlannedOutput& draft) {
    if (const std::string option = layer_option_with(draft, {"PRECISION", "SIGNIFICANT_FIGURES"});
        !option.empty())
        throw OptionError(option + " would round coordinates after " + draft.format.name +
                          " has converted them to longitudes and latitudes, which may cross polygons; give "
                          "-t_srs EPSG:4326 as well.");
}

void write_trial(const std::string& file, const std::string& folder, const PlannedOutput& draft, bool appends,
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

TrialDataset preflight_create(const PlannedOutput& draft) {
    reject_reserved_names(draft.format, draft.options, draft.layers);
    const reading::NoSidecar no_sidecar;
    const CPLConfigOptionSetter no_waiting("OGR_SQLITE_SYNCHRONOUS", "OFF", true);
    try {
        try {
            const VsimemFolder memory;
            return {true, create_in(memory.file(""), draft)};
        } catch (const OutputError&) {
            if (!draft.destination.local)
                throw;
            const StagingFolder beside(draft.destination.name, draft.destination.path);
            return {false, create_in(beside.folder().string() + "/", draft)};
        }
    } catch (const OutputError& error) {
        throw OutputError(with_advice(error.what(), draft.options));
    }
}

void preflight_stream(const PlannedOutput& draft) {
    const CapturedOutput discarded;
    try {
        DatasetWriter writer({draft.destination.name, ""}, draft.format, draft.options);
        writer.begin("/vsistdout/", DatasetWriter::Mode::create, draft.layers, draft.provenance);
    } catch (const OutputError& error) {
        std::string sentence = error.what();
        sentence.pop_back();
        throw OutputError(sentence + "; give the name of a file, or another format, such as GeoJSON.");
    }
}

void preflight_append(const PlannedOutput& draft) {
    const WriteTarget target{draft.destination.name, ""};
    const reading::CrsOwner srs = srs_of(draft.provenance.crs_wkt, target);
    const LayerSettings setting{target, draft.format, draft.options.layer_options, srs.get()};
    const reading::GdalMessages quiet;
    const reading::DatasetOwner dataset =
        open_dataset(draft.format, draft.destination.path, GDAL_OF_READONLY);
    for (const LayerSpec& spec : draft.layers)
        if (OGRLayerH layer = dataset ? find_layer(dataset.get(), draft.format, spec.name) : nullptr) {
            require_same_provenance(layer, draft.provenance, target);
            static_cast<void>(match_fields(layer, spec, setting));
        }
}

void preflight_replace(const PlannedOutput& draft) {
    const reading::GdalMessages quiet;
    const reading::DatasetOwner dataset =
        open_dataset(draft.format, draft.destination.path, GDAL_OF_READONLY);
    if (!dataset || GDALGetInternalHandle(dataset.get(), "SQLITE_HANDLE") == nullptr)
        return;
    std::vector<std::string> there;
    for (const LayerSpec& spec : draft.layers)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(dataset.get(), spec.name.c_str()))
            there.emplace_back(OGR_L_GetName(layer));
    const DependentObjects dependents(dataset.get(), there);
    if (!there.empty() && !dependents.empty())
        dependents.preflight({draft.destination.name, ""}, create_table_statements(draft));
}

CrsMismatch find_crs_mismatch(const VectorFormat& format, const std::string& destination,
                              const std::string& wkt, const Position& place) {
    const reading::GdalMessages messages;
    const reading::CrsOwner srs(wkt.empty() ? nullptr : OSRNewSpatialReference(wkt.c_str()));
    if (!srs || is_connection(format.driver, destination) ||
        !has_capability(format.driver, GDAL_DCAP_VIRTUALIO) || (format.name == "GPKG" && has_wkt1(srs.get())))
        return {};
    OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const VsimemFolder memory;
    const std::string file = memory.file(probe_name(format.driver, destination));
    reading::DatasetOwner dataset = create_trial(format.driver, file);
    const reading::GdalMessages of_layer;
    OGRLayerH layer = dataset ? add_trial_layer(dataset.get(), "probe", srs.get()) : nullptr;
    if (of_layer.failed())
        return accepts_wgs84(format.driver, destination) ? CrsMismatch{of_layer.reason()} : CrsMismatch{};
    const reading::GdalMessages quiet;
    if (layer == nullptr || !add_trial_feature(layer, place))
        return {};  // inconclusive
    dataset.reset();
    dataset = open_dataset(format, file, GDAL_OF_READONLY);
    layer = dataset ? GDALDatasetGetLayer(dataset.get(), 0) : nullptr;
    if (layer == nullptr || !is_at(layer, place))
        return {};
    OGRSpatialReferenceH back = OGR_L_GetSpatialRef(layer);
    if (back == nullptr)
        return {"it would be lost"};
    return same_kind(back, srs.get()) ? CrsMismatch{} : CrsMismatch{"", OSRGetName(back)};
}

std::optional<CoordinateRounding> coordinate_rounding(const PlannedOutput& draft, bool appends) {
    using To = CoordinateRounding::To;
    if (!has_capability(draft.format.driver, GDAL_DCAP_VIRTUALIO) || draft.layers.empty() ||
        draft.layers.front().points || !std::isfinite(draft.place.x + draft.place.y))
        return CoordinateRounding{};
    const reading::GdalMessages quiet;
    const reading::NoSidecar no_sidecar;
    const VsimemFolder memory;
    const std::string file = memory.file(probe_name(draft.format.driver, draft.destination.path));
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
    if (!appends)
        refuse_rounding_after_conversion(draft);
    return std::nullopt;
}

void warn_of_invalid(const WriteTarget& target, const VectorFormat& format, const std::string& path) {
    const reading::GdalMessages quiet;
    const reading::DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    for (int i = 0; dataset && i < GDALDatasetGetLayerCount(dataset.get()); ++i) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), i);
        std::int64_t invalid = 0;
        OGR_L_ResetReading(layer);
        while (const reading::FeatureOwner feature{OGR_L_GetNextFeature(layer)})
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

}  // namespace d2b::writing
