#include "write/replacing_refusals.hpp"

#include <optional>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

bool has_relations(GDALDatasetH dataset) {
    return sql_value(dataset,
                     "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'gpkgext_relations'")
        .has_value();
}

/// @param sql query for kind and name
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
    if (has_relations(dataset))
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
