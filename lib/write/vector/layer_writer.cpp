#include "write/vector/layer_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <variant>

#include <cpl_vsi.h>
#include <gdal_version.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "write/sql.hpp"

namespace d2b::writing {

namespace {

/// @return null if the features of the layer come from no other one, or from one that is not of OGR
const reading::OgrOriginalLayer* original_of(const LayerSpec& spec) {
    return dynamic_cast<const reading::OgrOriginalLayer*>(spec.original.get());
}

/// Creates the fields of the layer that features come from.
/// @return layer field index per field of that layer
std::vector<int> create_copied_fields(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting) {
    std::vector<int> indices;
    const reading::OgrOriginalLayer* const original = original_of(spec);
    for (int i = 0; original != nullptr && i < OGR_FD_GetFieldCount(original->definition()); ++i) {
        OGRFieldDefnH const field = OGR_FD_GetFieldDefn(original->definition(), i);
        OgrCall call(setting.target);
        const bool done = OGR_L_CreateField(layer, field, TRUE) == OGRERR_NONE;
        call.check(done, "creating field \"" + std::string(OGR_Fld_GetNameRef(field)) + "\" of layer \"" +
                             spec.name + "\"");
        indices.push_back(OGR_FD_GetFieldCount(OGR_L_GetLayerDefn(layer)) - 1);
    }
    return indices;
}

std::int64_t largest_fid(OGRLayerH layer) {
    std::int64_t largest = 0;
    OGR_L_ResetReading(layer);
    while (const reading::FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        largest = std::max<std::int64_t>(largest, OGR_F_GetFID(feature.get()));
    return largest;
}

/// Returns a real type for formats without 64-bit integers, such as MapInfo; it is exact for all our counts.
OGRFieldType integer_type(GDALDriverH driver) {
    const char* known = GDALGetMetadataItem(driver, GDAL_DMD_CREATIONFIELDDATATYPES, nullptr);
    return known == nullptr || std::string(known).find("Integer64") != std::string::npos ? OFTInteger64
                                                                                         : OFTReal;
}

OGRFieldType ogr_type(FieldType type, GDALDriverH driver) {
    switch (type) {
        case FieldType::integer:
            return integer_type(driver);
        case FieldType::real:
            return OFTReal;
        case FieldType::text:
            break;
    }
    return OFTString;
}

/// True if another layer has the title, in any case, because GDAL wants titles in a GeoPackage to be unique.
/// Ignores errors that GDAL reports about views on the layer being replaced, because it will exist again.
bool title_exists(GDALDatasetH dataset, const std::string& title) {
    const reading::GdalMessages quiet;
    if (EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "GPKG"))
        return sql_value(dataset, "SELECT 1 FROM gpkg_contents WHERE lower(identifier) = lower(" +
                                      sql_literal(title) + ")")
            .has_value();
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
        const char* other = GDALGetMetadataItem(GDALDatasetGetLayer(dataset, i), "IDENTIFIER", nullptr);
        if (other != nullptr && EQUAL(title.c_str(), other))
            return true;
    }
    return false;
}

/// Returns the first name that is no field of a layer; "" if that would be the driver's own choice.
std::string free_name(const reading::OgrOriginalLayer& original, std::initializer_list<std::string> names) {
    const std::vector<std::string> fields = original.field_names();
    const auto is_free = [&](const std::string& name) {
        return !name.empty() && std::ranges::none_of(fields, [&](const std::string& field) {
            return EQUAL(field.c_str(), name.c_str());
        });
    };
    const auto found = std::ranges::find_if(names, is_free);
    return found == names.end() || found == names.begin() + 1 ? "" : *found;
}

NameValueList layer_options(GDALDatasetH dataset, const LayerSpec& spec, const LayerSettings& setting) {
    NameValueList options(setting.options);
    const auto unique = [&](const std::string& title) {
        return title_exists(dataset, title) ? title + " (" + spec.name + ")" : title;
    };
    if (const char* given = CSLFetchNameValue(options.get(), "IDENTIFIER"))  // the same for several layers
        options.set("IDENTIFIER", unique(given));
    const auto offer = [&](const char* name, const std::string& value) {
        if (!value.empty() && !options.has(name) && has_layer_option(setting.format.driver, name))
            options.set(name, value);
    };
    offer("IDENTIFIER", unique(spec.title));
    offer("DESCRIPTION", spec.description);
    if (const reading::OgrOriginalLayer* const original = original_of(spec)) {
        offer("FID", free_name(*original, {original->fid_column(), "fid", "ogc_fid", "d2b_fid"}));
        offer("GEOMETRY_NAME",
              free_name(*original, {original->geometry_column(), "geom", "geometry", "d2b_geom"}));
    }
    // Temporary files belong next to the result, not into the working directory.
    offer("TEMPORARY_DIR", setting.target.hidden_folder);
    // By default these drivers silently drop geometries and characters.
    if (setting.format.name == "CSV")
        offer("GEOMETRY", "AS_WKT");
    if (setting.format.name == "ESRI Shapefile")
        offer("ENCODING", "UTF-8");
    return options;
}

FieldOwner field_of(const FieldSpec& spec, GDALDriverH driver) {
    FieldOwner field(OGR_Fld_Create(spec.name.c_str(), ogr_type(spec.type, driver)));
    if (!spec.alias.empty())
        OGR_Fld_SetAlternativeName(field.get(), spec.alias.c_str());
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0)
    if (!spec.description.empty())
        OGR_Fld_SetComment(field.get(), spec.description.c_str());
#endif
    return field;
}

OGRwkbGeometryType geometry_type(const LayerSpec& spec, GDALDriverH driver) {
    if (spec.points)
        return wkbPoint;
    if (const reading::OgrOriginalLayer* const original = original_of(spec))
        return original->geometry_type();
    const bool curves =
        spec.with_arcs && GDALGetMetadataItem(driver, GDAL_DCAP_CURVE_GEOMETRIES, nullptr) != nullptr;
    if (curves)
        return spec.with_z ? wkbMultiSurfaceZ : wkbMultiSurface;
    return spec.with_z ? wkbMultiPolygon25D : wkbMultiPolygon;
}

/// Creates a layer of MultiPolygons or points, with title and description if the format stores them; options
/// of the user take precedence. Warns if the format stores no geometries. @throws OutputError
OGRLayerH create_layer(GDALDatasetH dataset, const LayerSpec& spec, const LayerSettings& setting) {
    OgrCall call(setting.target);
    const NameValueList options = layer_options(dataset, spec, setting);
    // const_cast because the C API of GDAL 3.6 takes a mutable list, but does not change it.
    OGRLayerH layer =
        GDALDatasetCreateLayer(dataset, spec.name.c_str(), setting.srs,
                               geometry_type(spec, setting.format.driver), const_cast<char**>(options.get()));
    call.check(layer != nullptr, "creating layer \"" + spec.name + "\"");
    const bool keeps_none =
        OGR_FD_GetGeomFieldCount(OGR_L_GetLayerDefn(layer)) == 0 || OGR_L_GetGeomType(layer) == wkbNone;
    if (keeps_none && setting.target.warnings != nullptr && !options.has("GEOMETRY"))
        setting.target.warnings->add("Layer \"" + spec.name + "\" of \"" + setting.target.name +
                                     "\" gets no geometries: " + setting.format.name +
                                     " does not keep them.");
    return layer;
}

/// @return layer field index per field of the spec, because drivers may add fields of their own
/// @throws OutputError
std::vector<int> create_fields(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting) {
    std::vector<int> indices;
    for (const FieldSpec& field : spec.fields) {
        OgrCall call(setting.target);
        const bool done =
            OGR_L_CreateField(layer, field_of(field, setting.format.driver).get(), TRUE) == OGRERR_NONE;
        call.check(done, "creating field \"" + field.name + "\" of layer \"" + spec.name + "\"");
        OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
        const int index = OGR_FD_GetFieldIndex(fields, field.name.c_str());
        // If the driver has renamed the field, it is the last one.
        indices.push_back(index >= 0 ? index : OGR_FD_GetFieldCount(fields) - 1);
    }
    return indices;
}

}  // namespace

LayerWriter::LayerWriter(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting,
                         std::vector<int> fields)
    : layer_(layer),
      name_(OGR_L_GetName(layer)),
      target_(&setting.target),
      fields_(std::move(fields)),
      has_geometry_(OGR_FD_GetGeomFieldCount(OGR_L_GetLayerDefn(layer)) > 0),
      feature_(OGR_F_Create(OGR_L_GetLayerDefn(layer))),
      wkb_(spec.with_z, wkbFlatten(OGR_L_GetGeomType(layer)) == wkbMultiSurface),
      original_(original_of(spec)) {
    const auto height = std::ranges::find(spec.fields, spec.style.colour, &FieldSpec::name);
    if (!spec.style.colour.empty() && height != spec.fields.end())
        height_field_ = static_cast<std::size_t>(height - spec.fields.begin());
}

LayerWriter LayerWriter::create(GDALDatasetH dataset, const LayerSpec& spec, const LayerSettings& setting) {
    OGRLayerH layer = create_layer(dataset, spec, setting);
    std::vector<int> copied = create_copied_fields(layer, spec, setting);
    LayerWriter writer(layer, spec, setting, create_fields(layer, spec, setting));
    writer.copied_fields_ = std::move(copied);
    writer.is_new_ = true;
    return writer;
}

std::vector<std::string> LayerWriter::columns() const {
    std::vector<std::string> names;
    for (const int field : fields_)
        names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer_), field)));
    return names;
}

LayerWriter LayerWriter::adopt(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting) {
    LayerWriter writer(layer, spec, setting, match_fields(layer, spec, setting));
    OgrCall call(setting.target);
    writer.feature_count_ = OGR_L_GetFeatureCount(layer, TRUE);
    // This driver sorts by FID, which it reads from a field "id", and assigns free ones to new features.
    if (setting.format.name == "GeoJSON")
        writer.next_fid_ = largest_fid(layer) + 1;
    call.check(writer.feature_count_ >= 0, "counting the features of layer \"" + writer.name_ + "\"");
    return writer;
}

void LayerWriter::defer_index(GDALDatasetH dataset) {
    index_ = SpatialIndex::begin(dataset, layer_, *target_);
}

void LayerWriter::finish() {
    if (index_)
        index_->finish();
    index_.reset();
}

void LayerWriter::set(int field, const FieldValue& value) {
    OGRFeatureH feature = feature_.get();
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        OGR_F_SetFieldInteger64(feature, field, *integer);
    else if (const auto* real = std::get_if<double>(&value))
        OGR_F_SetFieldDouble(feature, field, *real);
    else if (const auto* text = std::get_if<std::string>(&value))
        OGR_F_SetFieldString(feature, field, text->c_str());
    else
        OGR_F_SetFieldNull(feature, field);
}

std::string LayerWriter::text_of(const Feature& feature) const {
    const auto* id = feature.values.empty() ? nullptr : std::get_if<std::int64_t>(&feature.values.front());
    return (id != nullptr ? "feature " + std::to_string(*id) : std::string("a feature")) + " of layer \"" +
           name_ + "\"";
}

OGRGeometryH LayerWriter::make_geometry(const Feature& feature) {
    const auto bytes = wkb_.encode(feature);
    OGRGeometryH geometry = nullptr;
    const bool done =
        OGR_G_CreateFromWkb(bytes.data(), nullptr, &geometry, static_cast<int>(bytes.size())) == OGRERR_NONE;
    wkb_.forget_large();  // a contour may fill the raster, and the driver makes its own copies
    return done ? geometry : nullptr;
}

void LayerWriter::add(const Feature& feature) {
    if (feature.values.size() != fields_.size())
        throw OutputError("Cannot write \"" + target_->name + "\": a feature of layer \"" + name_ +
                          "\" has " + std::to_string(feature.values.size()) + " values for " +
                          std::to_string(fields_.size()) + " fields.");
    OgrCall call(*target_);
    feature_.reset(original_ == nullptr ? feature_.release() : OGR_F_Create(OGR_L_GetLayerDefn(layer_)));
    OGR_F_SetFID(feature_.get(), next_fid_ == OGRNullFID ? OGRNullFID : next_fid_++);
    for (std::size_t i = 0; i < fields_.size(); ++i)
        set(fields_[i], feature.values[i]);
    bool done = true;
    if (original_ != nullptr) {
        copy_original(feature);
    } else if (has_geometry_) {
        OGRGeometryH geometry = make_geometry(feature);
        done = geometry != nullptr && OGR_F_SetGeometryDirectly(feature_.get(), geometry) == OGRERR_NONE;
    }
    done = done && OGR_L_CreateFeature(layer_, feature_.get()) == OGRERR_NONE;
    if (has_geometry_)
        OGR_F_SetGeometryDirectly(feature_.get(), nullptr);
    if (!done || !call.succeeded())
        call.fail("writing " + text_of(feature));
    call.pass_warnings();
    if (index_)
        index_->add(OGR_F_GetFID(feature_.get()), feature);
    ++feature_count_;
    if (height_field_)
        if (const double* height = std::get_if<double>(&feature.values[*height_field_]);
            height != nullptr && std::isfinite(*height))
            heights_.push_back(*height);
}

void LayerWriter::copy_original(const Feature& feature) {
    if (feature.original.empty()) {  // a trial
        if (OGRGeometryH geometry = make_geometry(feature))
            OGR_F_SetGeometryDirectly(feature_.get(),
                                      OGR_G_ForceTo(geometry, OGR_L_GetGeomType(layer_), nullptr));
        return;
    }
    const reading::FeatureOwner original = original_->decode(feature.original);
    // GDAL refuses a null pointer, which an empty vector may have.
    constexpr int no_field = -1;
    OGR_F_SetFromWithMap(feature_.get(), original.get(), TRUE,
                         copied_fields_.empty() ? &no_field : copied_fields_.data());
    OGR_F_SetFID(feature_.get(), OGR_F_GetFID(original.get()));
}

reading::CrsOwner srs_of(const std::string& wkt, const WriteTarget& target) {
    if (wkt.empty())
        return nullptr;
    OgrCall call(target);
    reading::CrsOwner srs(OSRNewSpatialReference(wkt.c_str()));
    call.check(srs != nullptr, "reading the CRS");
    OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return srs;
}

namespace {

std::string srs_name(OGRSpatialReferenceH srs) {
    const char* name = srs == nullptr ? nullptr : OSRGetName(srs);
    return name == nullptr ? "no CRS" : "\"" + std::string(name) + "\"";
}

bool same_srs(OGRSpatialReferenceH a, OGRSpatialReferenceH b) {
    const bool has_a = !reading::wkt_of(a).empty();
    const bool has_b = !reading::wkt_of(b).empty();
    if (!has_a || !has_b)
        return has_a == has_b;
    const std::array<const char*, 3> options{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                             "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
    return OSRIsSameEx(a, b, options.data()) != FALSE;
}

/// Accepts text for any type, because formats without a schema (CSV, GeoJSON) report text if they cannot
/// infer a type.
bool type_fits(FieldType wanted, OGRFieldType there) {
    switch (wanted) {
        case FieldType::integer:
            return there == OFTInteger64 || there == OFTInteger || there == OFTReal || there == OFTString;
        case FieldType::real:
            return there == OFTReal || there == OFTString;
        case FieldType::text:
            break;
    }
    return there == OFTString;
}

/// Returns the mismatch; "" if there is none.
std::string geometry_mismatch(OGRLayerH layer, const LayerSpec& spec) {
    const OGRwkbGeometryType type = OGR_L_GetGeomType(layer);
    const OGRwkbGeometryType flat = wkbFlatten(type);
    if (flat == wkbUnknown || flat == wkbNone)
        return "";
    const bool fits = spec.points ? flat == wkbPoint
                                  : flat == wkbMultiPolygon || flat == wkbPolygon || flat == wkbMultiSurface;
    if (!fits)
        return "holds geometries of type " + std::string(OGRGeometryTypeToName(type)) + " and not " +
               (spec.points ? "points" : "MultiPolygons");
    if ((OGR_GT_HasZ(type) != FALSE) != spec.with_z)
        return spec.with_z ? "has no Z, but the result has it" : "has Z, but the result has none";
    return "";
}

}  // namespace

std::vector<int> match_fields(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting) {
    const auto mismatch = [&](const std::string& what) {
        return OutputError("Cannot append to \"" + setting.target.name + "\": its layer \"" +
                           OGR_L_GetName(layer) + "\" " + what + "; write to another destination.");
    };
    OGRSpatialReferenceH there = OGR_L_GetSpatialRef(layer);
    if (setting.format.preserves_crs && !same_srs(there, setting.srs))
        throw mismatch("is in " + srs_name(there) + " and the result in " + srs_name(setting.srs));
    const std::string geometry = geometry_mismatch(layer, spec);
    if (!geometry.empty())
        throw mismatch(geometry);
    std::vector<int> indices;
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    for (const FieldSpec& field : spec.fields) {
        const int index = OGR_FD_GetFieldIndex(fields, field.name.c_str());
        if (index < 0)
            throw mismatch("has no field \"" + field.name + "\"");
        const OGRFieldType type = OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, index));
        if (!type_fits(field.type, type))
            throw mismatch("has field \"" + field.name + "\" with type " + OGR_GetFieldTypeName(type));
        indices.push_back(index);
    }
    return indices;
}

OGRLayerH find_layer(GDALDatasetH dataset, const VectorFormat& format, const std::string& name) {
    const reading::GdalMessages quiet;
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
    return layer == nullptr && !format.multiple_layers ? GDALDatasetGetLayer(dataset, 0) : layer;
}

void require_same_provenance(OGRLayerH layer, const Provenance& provenance, const WriteTarget& target) {
    for (const std::string& name : provenance.binding) {
        const char* there = GDALGetMetadataItem(layer, name.c_str(), nullptr);
        const auto ours = provenance.metadata.find(name);
        if (there != nullptr && ours != provenance.metadata.end() && ours->second != there)
            throw OutputError("Cannot append to \"" + target.name + "\": its layer \"" +
                              OGR_L_GetName(layer) + "\" has " + name + " \"" + there +
                              "\" and the result \"" + ours->second + "\"; write to another destination.");
    }
}

namespace {

int id_field(OGRLayerH layer, const LayerSpec& spec) {
    return spec.fields.empty()
               ? -1
               : OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), spec.fields.front().name.c_str());
}

std::int64_t largest_in_file(OGRLayerH layer, int field) {
    std::array<const char*, 3> ignored{"OGR_GEOMETRY", "OGR_STYLE", nullptr};
    OGR_L_SetIgnoredFields(layer, ignored.data());
    OGR_L_ResetReading(layer);
    std::int64_t largest = 0;
    while (const reading::FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        largest = std::max<std::int64_t>(largest, OGR_F_GetFieldAsInteger64(feature.get(), field));
    return largest;
}

}  // namespace

std::int64_t largest_id(const WriteTarget& target, GDALDatasetH database, std::span<const LayerSpec> layers) {
    std::int64_t largest = 0;
    for (const LayerSpec& spec : layers) {
        OGRLayerH layer = GDALDatasetGetLayerByName(database, spec.name.c_str());
        const int field = layer == nullptr ? -1 : id_field(layer, spec);
        if (field < 0)
            continue;
        const std::string name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), field));
        OgrCall call(target);
        const auto found =
            sql_value(database, "SELECT COALESCE(MAX(CAST(" + sql_identifier(name) +
                                    " AS BIGINT)), 0) AS n FROM " + sql_identifier(OGR_L_GetName(layer)));
        call.check(found.has_value(), "reading the numbers of layer \"" + spec.name + "\"");
        largest = std::max<std::int64_t>(largest, std::stoll(*found));
    }
    return largest;
}

std::int64_t largest_id(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                        std::span<const LayerSpec> layers) {
    OgrCall call(target);
    const reading::DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    std::int64_t largest = 0;
    for (const LayerSpec& spec : layers) {
        OGRLayerH layer = dataset ? find_layer(dataset.get(), format, spec.name) : nullptr;
        const int field = layer == nullptr ? -1 : id_field(layer, spec);
        if (field >= 0)
            largest = std::max(largest, largest_in_file(layer, field));
    }
    call.check(dataset != nullptr, "reading the numbers of its features");
    return largest;
}

namespace {

/// Falls back to the index, because a file that is one layer may have any layer name.
std::int64_t count_layer(GDALDatasetH dataset, const std::string& name, std::size_t index) {
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
    if (layer == nullptr)
        layer = GDALDatasetGetLayer(dataset, static_cast<int>(index));
    return layer == nullptr ? 0 : OGR_L_GetFeatureCount(layer, TRUE);
}

OutputError wrong_count(const WriteTarget& target, const std::string& layer, std::int64_t found,
                        std::int64_t expected) {
    return OutputError("Cannot write \"" + target.name + "\": layer \"" + layer + "\" holds " +
                       std::to_string(found) + " features when read back instead of " +
                       std::to_string(expected) + ".");
}

/// True for the empty file of a GeoJSON sequence without objects, which no driver recognizes.
bool is_empty_sequence(const std::string& path, const LayerCounts& counts) {
    VSIStatBufL status{};
    return std::ranges::all_of(counts, [](const auto& layer) { return layer.second == 0; }) &&
           VSIStatL(path.c_str(), &status) == 0 && status.st_size == 0;
}

}  // namespace

std::int64_t count_rows(const WriteTarget& target, GDALDatasetH dataset, const std::string& layer) {
    OgrCall call(target);
    const auto found = sql_value(dataset, "SELECT COUNT(*) AS n FROM " + sql_identifier(layer));
    call.check(found.has_value(), "counting the features of layer \"" + layer + "\"");
    return std::stoll(*found);
}

void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts) {
    for (const auto& [name, expected] : counts) {
        const std::int64_t found = count_rows(target, dataset, name);
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts) {
    if (GDALGetMetadataItem(format.driver, GDAL_DCAP_OPEN, nullptr) == nullptr)
        return;
    OgrCall call(target);
    const reading::DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    if (!dataset && is_empty_sequence(path, counts))
        return;
    call.check(dataset != nullptr, "reading the result back");
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto& [name, expected] = counts[i];
        const std::int64_t found = count_layer(dataset.get(), name, i);
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

}  // namespace d2b::writing
