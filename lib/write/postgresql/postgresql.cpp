#include "write/postgresql/postgresql.hpp"

#include <cstddef>
#include <string_view>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/sql.hpp"

namespace d2b::writing {

namespace {

/// First schema of the search path, which the destination may name; PostgreSQL silently skips it if it is not
/// usable.
constexpr std::string_view first_schema =
    R"(btrim(split_part(current_setting('search_path'), ',', 1), ' "'''))";

bool query_is_true(GDALDatasetH database, const std::string& condition) {
    const reading::GdalMessages quiet;
    return sql_value(database, "SELECT 1 AS n WHERE " + condition).has_value();
}

std::string query_text(GDALDatasetH database, const std::string& expression) {
    const reading::GdalMessages quiet;
    return sql_value(database, "SELECT " + expression + " AS text").value_or("");
}

/// Throws if options name another schema, because layers are only looked up in that of the connection.
void reject_other_schemas(const WriteOptions& options) {
    const std::string advice =
        ": name the schema in the destination, as in \"PG:dbname=town active_schema=plans\", so that layers "
        "are looked for where they are written.";
    if (NameValueList(options.layer_options).has("SCHEMA"))
        throw OptionError("-lco SCHEMA" + advice);
    if (options.layer_name.find('.') != std::string::npos)
        throw OptionError("-nln " + options.layer_name + advice);
}

void require_schema(const Destination& destination, GDALDatasetH database) {
    const std::string wanted = query_text(database, std::string(first_schema));
    if (destination.name.find("active_schema=") != std::string::npos &&
        query_text(database, "current_schema()") != wanted)
        throw OutputError("Cannot write \"" + destination.name + "\": there is no schema \"" + wanted +
                          "\" that its user may use; make it with CREATE SCHEMA, or name another one.");
}

void require_postgis(const Destination& destination, GDALDatasetH database, const WriteOptions& options) {
    if (!NameValueList(options.layer_options).has("GEOM_TYPE") &&
        !query_is_true(database, "EXISTS (SELECT 1 FROM pg_extension WHERE extname = 'postgis')"))
        throw OutputError("Cannot write \"" + destination.name +
                          "\": the database has no PostGIS, and QGIS finds no geometries without it; run "
                          "CREATE EXTENSION postgis in it first.");
}

[[noreturn]] void throw_missing_privilege(const Destination& destination, GDALDatasetH database,
                                          const std::string& what) {
    throw OutputError("Cannot write \"" + destination.name + "\": its user \"" +
                      query_text(database, "current_user") + "\" may not " + what + ".");
}

void require_rights_to_make(const Destination& destination, GDALDatasetH database) {
    if (query_is_true(database, "has_schema_privilege(current_schema(), 'CREATE')"))
        return;
    const std::string schema = sql_identifier(query_text(database, "current_schema()"));
    throw_missing_privilege(destination, database,
                            "make tables in schema " + schema + "; ask for GRANT CREATE ON SCHEMA " + schema +
                                ", or name another schema in the destination with active_schema=");
}

void require_rights_on(const std::string& layer, const Destination& destination, GDALDatasetH database,
                       bool replaces) {
    const std::string table = "to_regclass(" + sql_literal(sql_identifier(layer)) + ")";
    if (replaces) {
        if (!query_is_true(database,
                           "pg_has_role((SELECT relowner FROM pg_class WHERE oid = " + table + "), 'USAGE')"))
            throw_missing_privilege(destination, database,
                                    "replace layer \"" + layer +
                                        "\", which belongs to another user; write to another schema, choose "
                                        "another name with -nln, or let its owner run this");
        return;
    }
    // Appending takes a lock, for which PostgreSQL requires the UPDATE privilege.
    for (const char* right : {"SELECT", "INSERT", "UPDATE"})
        if (!query_is_true(database, "has_table_privilege(" + table + ", '" + right + "')"))
            throw_missing_privilege(destination, database,
                                    "add to layer \"" + layer +
                                        "\"; ask for GRANT SELECT, INSERT, UPDATE ON " +
                                        sql_identifier(layer));
}

constexpr const char* style_table =
    "FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace WHERE n.nspname = 'public' AND c.relname "
    "= "
    "'layer_styles'";

/// Statements about a new layer in the open transaction.
class PostgresqlTable {
  public:
    PostgresqlTable(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target)
        : dataset_(dataset), layer_(layer), target_(target), table_(sql_identifier(layer.table)) {}

    void comment() const;
    void make_indices() const;
    void style() const;

  private:
    void run_or_throw(const std::string& sql, const char* doing) const {
        sql_run_or_throw(dataset_, target_, sql, doing);
    }
    [[nodiscard]] bool query_is_true(const std::string& condition) const {
        OgrCall call(target_);
        const bool found = sql_value(dataset_, "SELECT 1 AS n WHERE " + condition).has_value();
        call.check(true, "looking for the table of styles");
        return found;
    }
    [[nodiscard]] bool has_styles_of_qgis() const;

    GDALDatasetH dataset_;
    const NewLayer& layer_;
    const WriteTarget& target_;
    std::string table_;
};

void PostgresqlTable::comment() const {
    for (std::size_t i = 0; i < layer_.columns.size(); ++i) {
        const FieldSpec& field = layer_.spec.fields[i];
        const std::string text =
            field.description.empty() ? field.alias : field.alias + ": " + field.description;
        run_or_throw("COMMENT ON COLUMN " + table_ + "." + sql_identifier(layer_.columns[i]) + " IS " +
                         sql_literal(text),
                     "describing the columns");
    }
}

void PostgresqlTable::make_indices() const {
    run_or_throw("CREATE UNIQUE INDEX ON " + table_ + " (" + sql_identifier(layer_.columns.front()) + ")",
                 "creating the index of ids");
    for (std::size_t i = 0; i < layer_.columns.size(); ++i)
        if (layer_.spec.fields[i].name == "bldg_id")
            run_or_throw("CREATE INDEX ON " + table_ + " (" + sql_identifier(layer_.columns[i]) + ")",
                         "creating the index of buildings");
}

/// Returns true if public.layer_styles has the columns of QGIS and is writable. Creates it like QGIS does if
/// the user may, under a lock because other programs may create it too. QGIS uses this one table for all
/// schemas.
bool PostgresqlTable::has_styles_of_qgis() const {
    run_or_throw("SELECT pg_advisory_xact_lock(hashtext('public.layer_styles'))",
                 "waiting for the table of styles");
    if (!query_is_true("EXISTS (SELECT 1 " + std::string(style_table) + ")")) {
        if (!query_is_true(R"(EXISTS (SELECT 1 FROM pg_namespace WHERE nspname = 'public' AND
                      has_schema_privilege(oid, 'USAGE') AND has_schema_privilege(oid, 'CREATE')))"))
            return false;
        run_or_throw(R"(CREATE TABLE public.layer_styles (id SERIAL PRIMARY KEY, f_table_catalog varchar,
                f_table_schema varchar, f_table_name varchar, f_geometry_column varchar, stylename text,
                styleqml xml, stylesld xml, useasdefault boolean, description text,
                owner varchar(63) DEFAULT CURRENT_USER, ui xml,
                update_time timestamp DEFAULT CURRENT_TIMESTAMP, type varchar))",
                     "creating the table of styles");
    }
    return query_is_true("EXISTS (SELECT 1 " + std::string(style_table) +
                         R"( AND has_schema_privilege(n.oid, 'USAGE') AND has_table_privilege(c.oid, 'SELECT')
                     AND has_table_privilege(c.oid, 'INSERT') AND has_table_privilege(c.oid, 'DELETE')
                     AND NOT EXISTS (SELECT 1 FROM pg_depend d JOIN pg_class s ON s.oid = d.objid
                         WHERE d.refobjid = c.oid AND CASE WHEN s.relkind = 'S'
                             THEN NOT has_sequence_privilege(s.oid, 'USAGE') ELSE false END)
                     AND (SELECT count(*) FROM pg_attribute WHERE attrelid = c.oid AND attname IN
                         ('f_table_catalog', 'f_table_schema', 'f_table_name', 'f_geometry_column',
                          'stylename', 'styleqml', 'useasdefault', 'description')) = 8))");
}

void PostgresqlTable::style() const {
    if (layer_.spec.style.title.empty() || layer_.geometry.empty() || !has_styles_of_qgis())
        return;
    const std::string of_layer =
        " FROM public.layer_styles WHERE f_table_catalog = current_database() AND f_table_schema = "
        "current_schema() AND f_table_name = " +
        sql_literal(layer_.table);
    const char* doing = "writing the style";
    run_or_throw("DELETE" + of_layer + " AND position(" + sql_literal(std::string(style_signature)) +
                     " in styleqml::text) > 0",
                 doing);
    for (const NamedStyle& style : qml_styles(layer_))
        run_or_throw(
            "INSERT INTO public.layer_styles (f_table_catalog, f_table_schema, f_table_name, "
            "f_geometry_column, stylename, styleqml, useasdefault, description) SELECT current_database(), "
            "current_schema(), " +
                sql_literal(layer_.table) + ", " + sql_literal(layer_.geometry) + ", " +
                sql_literal(style.name) + ", XMLPARSE(DOCUMENT " + sql_literal(style.qml) +
                "), NOT EXISTS (SELECT 1" + of_layer + " AND useasdefault), " + sql_literal(style.title),
            doing);
}

}  // namespace

void check_postgresql(const Destination& destination, GDALDatasetH database, const WriteOptions& options,
                      const std::vector<std::string>& names) {
    reject_other_schemas(options);
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

void throw_unreachable_postgresql(const Destination& destination, const std::string& reason) {
    throw OutputError("Cannot write \"" + destination.name + "\": its database cannot be reached (" + reason +
                      "); check whether psql reaches it.");
}

void complete_postgresql_table(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target) {
    const PostgresqlTable postgresql_table(dataset, layer, target);
    postgresql_table.comment();
    postgresql_table.make_indices();
    postgresql_table.style();
}

}  // namespace d2b::writing
