#include "write/postgresql_refusals.hpp"

#include <string_view>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

/// First schema of the search path, which the destination may name; PostgreSQL silently skips it if it is not
/// usable.
constexpr std::string_view first_schema =
    R"(btrim(split_part(current_setting('search_path'), ',', 1), ' "'''))";

bool holds(GDALDatasetH database, const std::string& condition) {
    const GdalMessages quiet;
    return sql_value(database, "SELECT 1 AS n WHERE " + condition).has_value();
}

std::string text_of(GDALDatasetH database, const std::string& expression) {
    const GdalMessages quiet;
    return sql_value(database, "SELECT " + expression + " AS text").value_or("");
}

/// Throws if options name another schema, because layers are only looked up in that of the connection.
void refuse_other_schemas(const WriteOptions& options) {
    const std::string advice =
        ": name the schema in the destination, as in \"PG:dbname=town active_schema=plans\", so that layers "
        "are looked for where they are written.";
    if (NameValueList(options.layer_options).has("SCHEMA"))
        throw OptionError("-lco SCHEMA" + advice);
    if (options.layer_name.find('.') != std::string::npos)
        throw OptionError("-nln " + options.layer_name + advice);
}

void require_schema(const Destination& destination, GDALDatasetH database) {
    const std::string wanted = text_of(database, std::string(first_schema));
    if (destination.name.find("active_schema=") != std::string::npos &&
        text_of(database, "current_schema()") != wanted)
        throw OutputError("Cannot write \"" + destination.name + "\": there is no schema \"" + wanted +
                          "\" that its user may use; make it with CREATE SCHEMA, or name another one.");
}

void require_postgis(const Destination& destination, GDALDatasetH database, const WriteOptions& options) {
    if (!NameValueList(options.layer_options).has("GEOM_TYPE") &&
        !holds(database, "EXISTS (SELECT 1 FROM pg_extension WHERE extname = 'postgis')"))
        throw OutputError("Cannot write \"" + destination.name +
                          "\": the database has no PostGIS, without which QGIS finds no geometries; run "
                          "CREATE EXTENSION postgis in it first.");
}

[[noreturn]] void refuse_user(const Destination& destination, GDALDatasetH database,
                              const std::string& what) {
    throw OutputError("Cannot write \"" + destination.name + "\": its user \"" +
                      text_of(database, "current_user") + "\" may not " + what + ".");
}

void require_rights_to_make(const Destination& destination, GDALDatasetH database) {
    if (holds(database, "has_schema_privilege(current_schema(), 'CREATE')"))
        return;
    const std::string schema = sql_name(text_of(database, "current_schema()"));
    refuse_user(destination, database,
                "make tables in schema " + schema + "; ask for GRANT CREATE ON SCHEMA " + schema +
                    ", or name another schema in the destination with active_schema=");
}

void require_rights_on(const std::string& layer, const Destination& destination, GDALDatasetH database,
                       bool replaces) {
    const std::string table = "to_regclass(" + sql_text(sql_name(layer)) + ")";
    if (replaces) {
        if (!holds(database,
                   "pg_has_role((SELECT relowner FROM pg_class WHERE oid = " + table + "), 'USAGE')"))
            refuse_user(destination, database,
                        "replace layer \"" + layer +
                            "\", which is another's; write to another schema or "
                            "with -nln, or let its owner run this");
        return;
    }
    // Appending takes a lock, for which PostgreSQL requires the UPDATE privilege.
    for (const char* right : {"SELECT", "INSERT", "UPDATE"})
        if (!holds(database, "has_table_privilege(" + table + ", '" + right + "')"))
            refuse_user(
                destination, database,
                "add to layer \"" + layer + "\"; ask for GRANT SELECT, INSERT, UPDATE ON " + sql_name(layer));
}

}  // namespace

void refuse_unfit_postgresql(const Destination& destination, GDALDatasetH database,
                             const WriteOptions& options, const std::vector<std::string>& names) {
    refuse_other_schemas(options);
    require_schema(destination, database);
    require_postgis(destination, database, options);
    bool makes = options.overwrite;
    for (const std::string& name : names) {
        OGRLayerH layer = GDALDatasetGetLayerByName(database, name.c_str());
        makes = makes || layer == nullptr;
        if (layer != nullptr && (options.overwrite || options.append))
            require_rights_on(OGR_L_GetName(layer), destination, database, options.overwrite);
    }
    if (makes)
        require_rights_to_make(destination, database);
}

void refuse_unreached_postgresql(const Destination& destination, const std::string& reason) {
    throw OutputError("Cannot write \"" + destination.name + "\": its database cannot be reached (" + reason +
                      "); check whether psql reaches it.");
}

}  // namespace d2b
