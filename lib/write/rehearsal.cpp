#include "write/rehearsal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <cpl_string.h>

#include "dem2buildings/error.hpp"
#include "read/config_option.hpp"
#include "write/dataset_writer.hpp"
#include "write/layer_create.hpp"
#include "write/layer_fit.hpp"
#include "write/reserved_names.hpp"
#include "write/sql.hpp"
#include "write/staging.hpp"
#include "write/trial_dataset.hpp"
#include "write/users_objects.hpp"

namespace d2b {

namespace {

/// Throws if a driver changes field names of a standard, because other programs look for them
/// (case-insensitive).
void refuse_cut_names(const Draft& draft, const DatasetWriter& writer) {
    if (draft.options.fields == FieldNames::own)
        return;
    for (std::size_t i = 0; i < draft.layers.size(); ++i) {
        const std::vector<std::string> columns = writer.columns(i);
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (const std::string& name = draft.layers[i].fields[k].name;
                !EQUAL(columns[k].c_str(), name.c_str()))
                throw OptionError("-fields: \"" + draft.destination.name + "\" would hold a field " +
                                  columns[k] + " in place of " + name +
                                  ", which no other program finds; write a GeoPackage.");
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

/// @param folder with trailing slash
void create_in(const std::string& folder, const Draft& draft) {
    const std::string name = std::filesystem::path(draft.destination.path).filename().string();
    const std::string file = folder + (name.empty() ? "trial" : name);
    const WriteTarget target{draft.destination.name, folder};
    DatasetWriter writer(target, draft.format, draft.options);
    writer.begin(file, DatasetWriter::Mode::create, draft.layers, draft.provenance);
    refuse_cut_names(draft, writer);
    for (std::size_t i = 0; i < draft.layers.size(); ++i)
        writer.add(i, trial_feature(draft.layers[i], draft.place));
    writer.close();
    verify_counts(target, draft.format, file, writer.counts());
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
std::vector<std::string> new_tables(const Draft& draft) {
    const MemoryFolder memory;
    const std::string file = memory.file(trial_name(draft.format.driver, draft.destination.path));
    DatasetWriter writer({draft.destination.name, memory.file("")}, draft.format, draft.options);
    writer.begin(file, DatasetWriter::Mode::create, draft.layers, draft.provenance);
    writer.close();
    const DatasetOwner dataset = open_dataset(draft.format, file, GDAL_OF_READONLY);
    std::vector<std::string> tables;
    for (const LayerSpec& layer : draft.layers)
        if (const auto sql = sql_value(dataset.get(),
                                       "SELECT sql FROM sqlite_master WHERE type = 'table' AND lower(name) "
                                       "= lower(" +
                                           sql_text(layer.name) + ")"))
            tables.push_back(*sql);
    return tables;
}

}  // namespace

bool rehearse_creating(const Draft& draft) {
    refuse_reserved_names(draft.format, draft.options, draft.layers);
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    const ConfigOption no_waiting("OGR_SQLITE_SYNCHRONOUS", "OFF");
    try {
        try {
            const MemoryFolder memory;
            create_in(memory.file(""), draft);
            return true;
        } catch (const OutputError&) {
            if (!draft.destination.local)
                throw;
            const Staging beside(draft.destination.name, draft.destination.path);
            create_in(beside.folder().string() + "/", draft);
            return false;
        }
    } catch (const OutputError& error) {
        throw OutputError(with_advice(error.what(), draft.options));
    }
}

void rehearse_adding(const Draft& draft) {
    const WriteTarget target{draft.destination.name, ""};
    const CrsOwner srs = srs_of(draft.provenance.crs_wkt, target);
    const LayerSetting setting{target, draft.format, draft.options.layer_options, srs.get()};
    const GdalMessages quiet;
    const DatasetOwner dataset = open_dataset(draft.format, draft.destination.path, GDAL_OF_READONLY);
    for (const LayerSpec& spec : draft.layers)
        if (OGRLayerH layer = dataset ? layer_called(dataset.get(), draft.format, spec.name) : nullptr) {
            require_same_origin(layer, draft.provenance, target);
            static_cast<void>(fitting_fields(layer, spec, setting));
        }
}

void rehearse_replacing(const Draft& draft) {
    const GdalMessages quiet;
    const DatasetOwner dataset = open_dataset(draft.format, draft.destination.path, GDAL_OF_READONLY);
    if (!dataset || GDALGetInternalHandle(dataset.get(), "SQLITE_HANDLE") == nullptr)
        return;
    std::vector<std::string> there;
    for (const LayerSpec& spec : draft.layers)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(dataset.get(), spec.name.c_str()))
            there.emplace_back(OGR_L_GetName(layer));
    const UsersObjects users(dataset.get(), there);
    if (!there.empty() && !users.empty())
        users.rehearse({draft.destination.name, ""}, new_tables(draft));
}

}  // namespace d2b
