#include "write/destination.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <system_error>
#include <thread>

#include <cpl_vsi.h>

#include "core/system/paths.hpp"
#include "dem2buildings/error.hpp"
#include "options/provenance_text.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_util.hpp"
#include "write/postgresql/postgresql.hpp"
#include "write/qgis/qgis_style.hpp"
#include "write/sql.hpp"
#include "write/staging.hpp"
#include "write/vector/dxf_sink.hpp"

namespace d2b::writing {

namespace {

namespace fs = std::filesystem;

std::string without_slashes(std::string path) {
    while (path.size() > 1 && path.back() == '/')
        path.pop_back();
    return path;
}

}  // namespace

fs::path resolved_path(const std::string& name) {
    std::error_code error;
    fs::path path = without_slashes(name);
    // std::filesystem does not follow links to files that do not exist yet.
    for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links)
        path = path.parent_path() / fs::read_symlink(path, error);
    return path;
}

void check_parent_folder(const std::string& name, const fs::path& path) {
    // Permission bits do not cover read-only and special file systems, and do not apply to root.
    const StagingFolder trial(name, path);
}

namespace {

std::string in_quotes(const std::string& text) {
    return "\"" + text + "\"";
}

/// Returns a file name up to its first dot.
std::string stem_of(const fs::path& path) {
    const std::string file = path.filename().string();
    return file.substr(0, file.find('.', 1));
}

[[noreturn]] void refuse_sibling(const std::string& name, const fs::path& sibling) {
    throw OptionError("Writing " + in_quotes(name) + " would replace " + in_quotes(sibling.string()) +
                      "; remove that file first or choose another name.");
}

void check_siblings(const std::string& name, const fs::path& path, const VectorFormat& format) {
    for (const std::string& suffix : format.suffixes) {
        const fs::path sibling = path.parent_path() / (stem_of(path) + suffix);
        std::error_code error;
        if (sibling != path && fs::exists(sibling, error))
            refuse_sibling(name, sibling);
    }
}

void resolve_local(Destination& destination, const VectorFormat& format) {
    const fs::path path = resolved_path(destination.name);
    destination.local = true;
    destination.path = path.string();
    std::error_code error;
    destination.exists = fs::exists(path, error);
    if (fs::is_directory(path, error)) {
        if (!format.folder)
            throw OptionError(in_quotes(destination.name) + " is a folder, and " + format.name +
                              " writes a file here; give the name of a file.");
        if (fs::is_empty(path, error))
            destination.exists = false;
    }
    check_parent_folder(destination.name, path);
    if (!destination.exists)
        check_siblings(destination.name, path, format);
}

}  // namespace

void reject_archive(const std::string& name) {
    constexpr std::array archives{"/vsizip/", "/vsitar/", "/vsi7z/", "/vsirar/"};
    constexpr std::array read_only{"/vsicurl/",    "/vsicurl?",  "/vsicurl_streaming/",
                                   "/vsisubfile/", "/vsistdin/", "/vsistdin?"};
    const auto begins = [&](const char* prefix) { return name.starts_with(prefix); };
    if (std::ranges::any_of(archives, begins))
        throw OptionError(
            in_quotes(name) +
            " is in an archive, which cannot be written to; give a file, and pack it afterwards.");
    if (std::ranges::any_of(read_only, begins))
        throw OptionError(in_quotes(name) + " can only be read; give a file.");
}

Destination locate(const WriteOptions& options, const VectorFormat& format) {
    if (options.overwrite && options.append)
        throw OptionError("-overwrite and -append exclude each other; give one of them.");
    Destination destination{.name = redacted_destination(options.destination), .path = options.destination};
    if (is_stream(options.destination) || is_connection(format.driver, options.destination))
        return destination;
    reject_archive(options.destination);
    if (options.destination.starts_with("/vsi")) {
        VSIStatBufL status{};
        destination.exists = VSIStatExL(options.destination.c_str(), &status,
                                        VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0;
    } else {
        resolve_local(destination, format);
    }
    if (destination.exists && !options.overwrite && !options.append)
        throw OptionError(
            in_quotes(options.destination) +
            (is_drawing(format)
                 ? " exists; give -overwrite to replace it."
                 : " exists; give -overwrite to replace the layers of this run in it, or -append to add to "
                   "them."));
    return destination;
}

namespace {

/// True if the name is among the names; case-insensitive, because OGR compares layer names like that.
bool contains_name(const std::vector<std::string>& names, const std::string& name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& other) { return EQUAL(other.c_str(), name.c_str()); });
}

/// Returns the first file of the folder that is not part of our layers; "" if there is none.
std::string foreign_file(const fs::path& folder, GDALDatasetH dataset,
                         const std::vector<std::string>& names) {
    const CPLStringList listed(GDALGetFileList(dataset));
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::string file = entry.path().filename().string();
        const bool part = CSLFindString(listed.List(), entry.path().string().c_str()) >= 0 ||
                          contains_name(names, entry.path().stem().string()) ||
                          contains_name(names, file.substr(0, file.find('.')));
        if (!part)
            return file;
    }
    return "";
}

/// Waits briefly for a lock, then throws. BEGIN IMMEDIATE is needed because other writers block it, but not
/// reading.
void reject_locked(const Destination& destination, GDALDatasetH dataset) {
    using std::chrono::steady_clock;
    constexpr std::chrono::seconds longest(3);
    constexpr std::chrono::milliseconds between(50);
    for (const auto start = steady_clock::now();; std::this_thread::sleep_for(between)) {
        const reading::GdalMessages messages;
        GDALDatasetExecuteSQL(dataset, "BEGIN IMMEDIATE", nullptr, nullptr);
        if (!messages.failed())
            break;
        if (steady_clock::now() - start > longest)
            throw OutputError("Cannot write \"" + destination.name + "\": locking it failed (" +
                              messages.reason_for(destination.path) + ")" + advice_for(messages.reason()) +
                              ".");
    }
    const reading::GdalMessages quiet;
    GDALDatasetExecuteSQL(dataset, "ROLLBACK", nullptr, nullptr);
}

/// Adds the first feature of a layer once more, because some drivers that cannot do so say that they can.
bool takes_another_feature(OGRLayerH layer) {
    const reading::FeatureOwner first(OGR_L_GetNextFeature(layer));
    if (!first)
        return true;
    OGR_F_SetFID(first.get(), OGRNullFID);
    return OGR_L_CreateFeature(layer, first.get()) == OGRERR_NONE;
}

/// True if features can be added to our layers. @param is_copy true if one may be added on trial
bool is_appendable(GDALDatasetH dataset, const VectorFormat& format, const std::vector<std::string>& names,
                   bool is_copy) {
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (format.multiple_layers && !contains_name(names, OGR_L_GetName(layer)))
            continue;
        if (OGR_L_TestCapability(layer, OLCSequentialWrite) == FALSE ||
            (is_copy && !takes_another_feature(layer)))
            return false;
    }
    return true;
}

/// Checks formats whose datasets are replaced whole. @param own layers that the run writes
/// @throws OptionError if layers or files of others would be lost
void reject_foreign_data(const Destination& destination, const ExistingDataset& existing,
                         GDALDatasetH dataset, const VectorFormat& format, const WriteOptions& options,
                         const std::vector<std::string>& own) {
    std::vector<std::string> names = own;
    // A user's layer of the name of an index has features. An index may be no layer.
    for (const std::string& index : format.indices)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(dataset, index.c_str());
            layer == nullptr || OGR_L_GetFeatureCount(layer, TRUE) == 0)
            names.push_back(index);
    const std::string flag = options.overwrite ? "-overwrite" : "-append";
    if (options.overwrite || format.folder) {
        for (const std::string& layer : existing.layers)
            if (format.multiple_layers ? !contains_name(names, layer) : existing.layers.size() > 1)
                throw OptionError(
                    "\"" + destination.name + "\" also holds layer \"" + layer + "\", which " + flag +
                    " would lose: " + format.name +
                    " datasets are replaced whole; write to another destination or remove it first.");
    }
    std::error_code error;
    if (!destination.local || !fs::is_directory(destination.path, error))
        return;
    const std::string file = foreign_file(destination.path, dataset, names);
    if (!file.empty())
        throw OptionError("The folder \"" + destination.name + "\" also holds \"" + file + "\", which " +
                          flag +
                          " would touch: folders are replaced whole; write to another folder or move it away "
                          "first.");
}

/// @throws OutputError if a database cannot be opened for writing @throws OptionError if -append is given and
/// the driver cannot append to existing layers
void require_writable(const Destination& destination, const ExistingDataset& existing,
                      const VectorFormat& format, const WriteOptions& options,
                      const std::vector<std::string>& names) {
    const reading::GdalMessages messages;
    const int refusal = destination.local ? system::write_refusal(destination.path) : 0;
    if (refusal != 0 && refusal != ENOENT)
        throw OutputError("Cannot write \"" + destination.name + "\": it is read-only (" +
                          std::generic_category().message(refusal) +
                          "); allow writing, or choose another destination.");
    if (options.overwrite && !format.transactions)
        return;  // because it is replaced whole
    // Open a copy, because some drivers change a file as soon as they open it for writing.
    std::optional<StagingFolder> copy;
    if (destination.local && !format.transactions)
        copy.emplace(destination.name, destination.path).copy_in(existing.old.files);
    const reading::DatasetOwner dataset =
        open_dataset(format, copy ? copy->dataset().string() : destination.path, GDAL_OF_UPDATE);
    if (!dataset && format.transactions)
        throw OutputError("Cannot write \"" + destination.name + "\": opening it for writing failed (" +
                          messages.reason() + ")" + advice_for(messages.reason()) + ".");
    if (format.name == "GPKG" || format.name == "SQLite")
        reject_locked(destination, dataset.get());
    if (!options.append)
        return;
    if (!dataset || !is_appendable(dataset.get(), format, names, copy.has_value()))
        throw OptionError("GDAL cannot append to \"" + destination.name + "\", a dataset of format " +
                          format.name + "; write to another destination, or to a GeoPackage.");
}

bool has_relations(GDALDatasetH dataset) {
    return sql_value(dataset,
                     "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'gpkgext_relations'")
        .has_value();
}

/// @param sql query for kind and name
void reject_dependents(const Destination& destination, GDALDatasetH dataset, const std::string& layer,
                       const std::string& sql) {
    const reading::GdalMessages quiet;
    std::optional<SqlRow> first;
    sql_query(dataset, sql, [&](const SqlRow& row) {
        if (!first)
            first = row;
    });
    if (first)
        throw OptionError(
            "\"" + destination.name + "\" has a " + first->at(0) + " \"" + first->at(1) + "\" on layer \"" +
            layer + "\", which -overwrite would break; remove it first, or write to another destination.");
}

void reject_in_sqlite(const Destination& destination, GDALDatasetH dataset, const std::string& layer) {
    const std::string text = sql_literal(layer);
    if (has_relations(dataset))
        reject_dependents(
            destination, dataset, layer,
            "SELECT 'relation', mapping_table_name FROM gpkgext_relations WHERE lower(base_table_name) = "
            "lower(" +
                text + ") OR lower(related_table_name) = lower(" + text + ")");
    reject_dependents(
        destination, dataset, layer,
        "SELECT 'foreign key of table', m.name FROM sqlite_master m, pragma_foreign_key_list(m.name) k "
        "WHERE m.type = 'table' AND lower(k.\"table\") = lower(" +
            text + ") AND lower(m.name) <> lower(" + text + ")");
}

void reject_in_postgresql(const Destination& destination, GDALDatasetH dataset, const std::string& layer) {
    const std::string table = "to_regclass(" + sql_literal(sql_identifier(layer)) + ")";
    reject_dependents(
        destination, dataset, layer,
        "SELECT DISTINCT 'view' AS kind, c.relname AS name FROM pg_depend d JOIN pg_rewrite r ON r.oid = "
        "d.objid JOIN pg_class c ON c.oid = r.ev_class WHERE d.classid = 'pg_rewrite'::regclass AND "
        "d.refobjid = " +
            table + " AND c.oid <> d.refobjid");
    reject_dependents(
        destination, dataset, layer,
        "SELECT 'trigger' AS kind, tgname AS name FROM pg_trigger WHERE NOT tgisinternal AND tgrelid = " +
            table);
    reject_dependents(
        destination, dataset, layer,
        "SELECT 'foreign key' AS kind, conname AS name FROM pg_constraint WHERE contype = 'f' AND "
        "confrelid = " +
            table + " AND conrelid <> confrelid");
}

/// Rejects -overwrite if it would break relations and foreign keys, whose ids would then refer to other
/// features, or views and triggers of PostgreSQL, which drops them with the table. @param names of the layers
/// @throws OptionError naming the first one
void reject_breaking_replacement(const Destination& destination, GDALDatasetH dataset,
                                 const VectorFormat& format, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
        if (layer == nullptr)
            continue;
        if (format.name == "PostgreSQL")
            reject_in_postgresql(destination, dataset, OGR_L_GetName(layer));
        else if (format.transactions && GDALGetInternalHandle(dataset, "SQLITE_HANDLE") != nullptr)
            reject_in_sqlite(destination, dataset, OGR_L_GetName(layer));
    }
}

/// Sidecar files of a .shp, replaced with it because an old index would not match the new file.
constexpr std::array shapefile_sidecars{".shx", ".dbf", ".prj", ".cpg", ".qix", ".sbn",
                                        ".sbx", ".qpj", ".idm", ".ind", ".cst"};

std::vector<std::string> files_of(GDALDatasetH dataset, const fs::path& path, const VectorFormat& format) {
    std::error_code error;
    if (fs::is_directory(path, error))
        return {path.string()};
    std::vector<std::string> files{path.string()};
    const auto add = [&](const fs::path& file) {
        if (file.parent_path() == path.parent_path() && fs::is_regular_file(file, error) &&
            std::find(files.begin(), files.end(), file.string()) == files.end())
            files.push_back(file.string());
    };
    const CPLStringList listed(GDALGetFileList(dataset));
    for (int i = 0; i < listed.Count(); ++i)
        add(listed[i]);
    if (format.name == "ESRI Shapefile" && format.suffixes.size() > 1)
        for (const char* suffix : shapefile_sidecars)
            add(fs::path(path).replace_extension(suffix));
    const fs::path style = fs::path(path).replace_extension(".qml");
    if (format.name == "ESRI Shapefile" && is_our_style(style))
        add(style);
    return files;
}

/// Advises to remove the file only if neither a disk error nor a lock is to blame.
[[noreturn]] void throw_unreadable(const Destination& destination, const VectorFormat& format,
                                   const reading::GdalMessages& messages) {
    std::error_code error;
    std::ifstream file(fs::path(destination.path), std::ios::binary);
    char first = 0;
    const bool unreadable = fs::is_regular_file(destination.path, error) &&
                            fs::file_size(destination.path, error) > 0 && !file.get(first);
    const std::array<const char*, 2> drivers{format.name.c_str(), nullptr};
    const bool ours = format.transactions && GDALIdentifyDriverEx(destination.path.c_str(), GDAL_OF_VECTOR,
                                                                  drivers.data(), nullptr) != nullptr;
    if (unreadable || ours)
        throw OutputError("Cannot write \"" + destination.name + "\": it exists and cannot be opened (" +
                          messages.reason_for(destination.path) + ")" + advice_for(messages.reason()) + ".");
    throw OptionError("\"" + destination.name + "\" exists and is not a dataset of format " + format.name +
                      "; remove it first.");
}

}  // namespace

ExistingDataset inspect_existing(const Destination& destination, const VectorFormat& format,
                                 const WriteOptions& options, const std::vector<std::string>& names) {
    const reading::GdalMessages messages;
    const reading::NetworkGuard gate(
        destination.path);  // because some drivers read on only when their layers are asked for
    ExistingDataset existing;
    // Opening for writing rolls back the transaction of a killed run; the file may be unreadable before.
    if (format.transactions)
        open_dataset(format, destination.path, GDAL_OF_UPDATE);
    reading::DatasetOwner dataset = open_dataset(format, destination.path, GDAL_OF_READONLY);
    if (!dataset)  // datasets with rasters only must be opened as rasters
        dataset = open_dataset(format, destination.path, GDAL_OF_RASTER | GDAL_OF_READONLY);
    if (!dataset)
        throw_unreadable(destination, format, messages);
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset.get()); ++i)
        existing.layers.emplace_back(OGR_L_GetName(GDALDatasetGetLayer(dataset.get(), i)));
    if (destination.local)
        existing.old.files = files_of(dataset.get(), destination.path, format);
    existing.old.stamp = stamp_of(existing.old.files);
    if (!format.transactions)
        reject_foreign_data(destination, existing, dataset.get(), format, options, names);
    if (options.overwrite)
        reject_breaking_replacement(destination, dataset.get(), format, names);
    require_writable(destination, existing, format, options, names);
    return existing;
}

namespace {

/// Returns the first file of another dataset of the same stem that includes this file; "" if there is none.
/// @param names of files that are no other dataset
std::string owner_of(const fs::path& sibling, const std::vector<std::string>& names) {
    const reading::GdalMessages quiet;
    const fs::path folder = sibling.parent_path();
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder)) {
        const std::string file = entry.path().filename().string();
        if (stem_of(file) != stem_of(sibling) || !entry.is_regular_file() || contains_name(names, file))
            continue;
        const reading::DatasetOwner dataset =
            reading::open_guarded(entry.path().string(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY);
        const CPLStringList listed(dataset ? GDALGetFileList(dataset.get()) : nullptr);
        for (int i = 0; i < listed.Count(); ++i)
            if (fs::path(listed[i]).filename() == sibling.filename())
                return fs::path(listed[0]).filename().string();
    }
    return "";
}

}  // namespace

void claim_files(const Destination& destination, const VectorFormat& format,
                 std::optional<ExistingDataset>& existing, std::vector<std::string> names) {
    const fs::path path = destination.path;
    for (const std::string& suffix : format.suffixes)
        names.push_back(stem_of(path) + suffix);
    names.push_back(path.filename().string());
    for (const std::string& name : names) {
        const fs::path sibling = path.parent_path() / name;
        std::error_code error;
        // keep_user_styles() decides on styles, because users make their own.
        if (sibling == path || sibling.extension() == ".qml" || !fs::exists(sibling, error))
            continue;
        if (!existing)
            refuse_sibling(destination.name, sibling);
        if (std::ranges::find(existing->old.files, sibling.string()) != existing->old.files.end())
            continue;
        if (const std::string owner = owner_of(sibling, names); !owner.empty())
            throw OptionError("Writing " + in_quotes(destination.name) + " would replace " +
                              in_quotes(sibling.string()) + ", a file of " + in_quotes(owner) +
                              "; choose another name.");
        existing->old.files.push_back(sibling.string());
        existing->old.stamp += stamp_of({sibling.string()});
    }
}

std::optional<ExistingDataset> inspect_database(const Destination& destination, VectorFormat& format,
                                                const WriteOptions& options,
                                                const std::vector<std::string>& names) {
    const reading::GdalMessages messages;
    const reading::DatasetOwner dataset = open_dataset(format, destination.path, GDAL_OF_UPDATE);
    if (!dataset && format.name == "PostgreSQL")
        throw_unreachable_postgresql(destination, messages.reason());
    if (!dataset)
        return std::nullopt;
    format.transactions = has_native_transactions(dataset.get());
    if (format.name == "PostgreSQL")
        check_postgresql(destination, dataset.get(), options, names);
    ExistingDataset existing;
    for (const std::string& name : names) {
        if (GDALDatasetGetLayerByName(dataset.get(), name.c_str()) == nullptr)
            continue;
        existing.layers.push_back(name);
        if (options.overwrite)
            reject_breaking_replacement(destination, dataset.get(), format, {name});
        if (!options.overwrite && !options.append)
            throw OptionError(
                "\"" + destination.name + "\" has a layer \"" + name +
                "\"; give -overwrite to replace it, -append to add to it, or -nln for another name.");
    }
    return existing;
}

}  // namespace d2b::writing
