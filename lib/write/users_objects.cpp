#include "write/users_objects.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

/// Triggers that GDAL and SpatiaLite make, and make again.
bool is_drivers_own(const std::string& name, const std::string& layer) {
    static constexpr std::array prefixes{"ggi_", "ggu_", "gii_", "giu_", "gid_", "tmi_", "tmu_", "tmd_"};
    return name.starts_with("rtree_" + layer + "_") || name == "trigger_insert_feature_count_" + layer ||
           name == "trigger_delete_feature_count_" + layer ||
           std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const char* prefix) { return name.starts_with(prefix + layer + "_"); });
}

/// What the database says against a statement; "" where it takes it.
std::string objection(GDALDatasetH dataset, const std::string& sql) {
    const GdalMessages messages;
    if (OGRLayerH rows = GDALDatasetExecuteSQL(dataset, sql.c_str(), nullptr, nullptr))
        GDALDatasetReleaseResultSet(dataset, rows);
    return messages.failed() ? messages.first_reason() : "";
}

bool is_there(GDALDatasetH dataset, const std::string& type, const std::string& name) {
    return sql_value(dataset, "SELECT 1 FROM sqlite_master WHERE type = " + sql_text(type) +
                                  " AND name = " + sql_text(name))
        .has_value();
}

std::string view_query(const std::string& view) {
    return "SELECT * FROM " + sql_name(view) + " LIMIT 0";
}

/// @param sql gives the kind and the name of each
void refuse_found(const Destination& destination, GDALDatasetH dataset, const std::string& layer,
                  const std::string& sql) {
    const GdalMessages quiet;
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

void refuse_in_sqlite(const Destination& destination, GDALDatasetH dataset, const std::string& layer) {
    const std::string text = sql_text(layer);
    if (is_there(dataset, "table", "gpkgext_relations"))
        refuse_found(
            destination, dataset, layer,
            "SELECT 'relation', mapping_table_name FROM gpkgext_relations WHERE lower(base_table_name) = "
            "lower(" +
                text + ") OR lower(related_table_name) = lower(" + text + ")");
    refuse_found(
        destination, dataset, layer,
        "SELECT 'foreign key of table', m.name FROM sqlite_master m, pragma_foreign_key_list(m.name) k "
        "WHERE m.type = 'table' AND lower(k.\"table\") = lower(" +
            text + ") AND lower(m.name) <> lower(" + text + ")");
}

void refuse_in_postgresql(const Destination& destination, GDALDatasetH dataset, const std::string& layer) {
    const std::string table = "to_regclass(" + sql_text(sql_name(layer)) + ")";
    refuse_found(
        destination, dataset, layer,
        "SELECT DISTINCT 'view' AS kind, c.relname AS name FROM pg_depend d JOIN pg_rewrite r ON r.oid = "
        "d.objid JOIN pg_class c ON c.oid = r.ev_class WHERE d.classid = 'pg_rewrite'::regclass AND "
        "d.refobjid = " +
            table + " AND c.oid <> d.refobjid");
    refuse_found(
        destination, dataset, layer,
        "SELECT 'trigger' AS kind, tgname AS name FROM pg_trigger WHERE NOT tgisinternal AND tgrelid = " +
            table);
    refuse_found(destination, dataset, layer,
                 "SELECT 'foreign key' AS kind, conname AS name FROM pg_constraint WHERE contype = 'f' AND "
                 "confrelid = " +
                     table + " AND conrelid <> confrelid");
}

}  // namespace

UsersObjects::UsersObjects(GDALDatasetH dataset, std::vector<std::string> layers)
    : dataset_(dataset), layers_(std::move(layers)) {
    const GdalMessages quiet;
    // GDAL reads the columns of a layer when it first needs them. Those of a view cannot be read while what
    // it shows is being replaced.
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i)
        OGR_L_GetLayerDefn(GDALDatasetGetLayer(dataset_, i));
    for (const std::string& layer : layers_)
        sql_query(
            dataset_,
            "SELECT type, name, sql FROM sqlite_master WHERE type IN ('trigger', 'index') AND sql IS NOT "
            "NULL AND lower(tbl_name) = lower(" +
                sql_text(layer) + ") ORDER BY rowid",
            [&](const SqlRow& row) {
                if (!is_drivers_own(row[1], layer))
                    gone_with_tables_.push_back({row[0], row[1], row[2]});
            });
    sql_query(dataset_, "SELECT name FROM sqlite_master WHERE type = 'view'",
              [&](const SqlRow& row) { views_.push_back(row[0]); });
    std::erase_if(views_,
                  [&](const std::string& view) { return !objection(dataset_, view_query(view)).empty(); });
}

void UsersObjects::bring_back(const WriteTarget& target) const {
    const auto require = [&](const std::string& sql, const std::string& what) {
        const std::string reason = objection(dataset_, sql);
        if (!reason.empty())
            throw OutputError("Cannot write \"" + target.name + "\": its " + what +
                              " does not fit the new layers (" + reason +
                              "); remove it first, or write to another destination.");
    };
    for (const Object& object : gone_with_tables_) {
        const std::string what = object.type + " \"" + object.name + "\"";
        if (!is_there(dataset_, object.type, object.name))
            require(object.sql, what);
        // What a trigger does is looked at when it is called for the first time.
        if (object.type == "trigger")
            for (const std::string& layer : layers_)
                for (const char* sql : {"EXPLAIN INSERT INTO @ DEFAULT VALUES", "EXPLAIN DELETE FROM @",
                                        "EXPLAIN UPDATE @ SET rowid = rowid"}) {
                    std::string text = sql;
                    require(text.replace(text.find('@'), 1, sql_name(layer)), what);
                }
    }
    for (const std::string& view : views_)
        require(view_query(view), "view \"" + view + "\"");
}

void refuse_what_would_break(const Destination& destination, GDALDatasetH dataset, const VectorFormat& format,
                             const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
        if (layer == nullptr)
            continue;
        if (format.name == "PostgreSQL")
            refuse_in_postgresql(destination, dataset, OGR_L_GetName(layer));
        else if (format.transactions && GDALGetInternalHandle(dataset, "SQLITE_HANDLE") != nullptr)
            refuse_in_sqlite(destination, dataset, OGR_L_GetName(layer));
    }
}

}  // namespace d2b
