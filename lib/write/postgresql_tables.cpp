#include "write/postgresql_tables.hpp"

#include <cstddef>
#include <string>

#include "write/qml_style.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

constexpr const char* style_table =
    "FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace WHERE n.nspname = 'public' AND c.relname "
    "= "
    "'layer_styles'";

/// Statements about a new layer in the open transaction.
class Furnishing {
  public:
    Furnishing(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target)
        : dataset_(dataset), layer_(layer), target_(target), table_(sql_name(layer.table)) {}

    void comment() const;
    void make_indices() const;
    void style() const;

  private:
    void must(const std::string& sql, const char* doing) const { sql_must(dataset_, target_, sql, doing); }
    [[nodiscard]] bool holds(const std::string& condition) const {
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

void Furnishing::comment() const {
    for (std::size_t i = 0; i < layer_.columns.size(); ++i) {
        const FieldSpec& field = layer_.spec.fields[i];
        const std::string text =
            field.description.empty() ? field.alias : field.alias + ": " + field.description;
        must("COMMENT ON COLUMN " + table_ + "." + sql_name(layer_.columns[i]) + " IS " + sql_text(text),
             "describing the columns");
    }
}

void Furnishing::make_indices() const {
    must("CREATE UNIQUE INDEX ON " + table_ + " (" + sql_name(layer_.columns.front()) + ")",
         "making the index of numbers");
    for (std::size_t i = 0; i < layer_.columns.size(); ++i)
        if (layer_.spec.fields[i].name == "bldg_id")
            must("CREATE INDEX ON " + table_ + " (" + sql_name(layer_.columns[i]) + ")",
                 "making the index of buildings");
}

/// Returns true if public.layer_styles has the columns of QGIS and is writable. Creates it like QGIS does if
/// the user may, under a lock because other programs may create it too. QGIS uses this one table for all
/// schemas.
bool Furnishing::has_styles_of_qgis() const {
    must("SELECT pg_advisory_xact_lock(hashtext('public.layer_styles'))", "waiting for the table of styles");
    if (!holds("EXISTS (SELECT 1 " + std::string(style_table) + ")")) {
        if (!holds(R"(EXISTS (SELECT 1 FROM pg_namespace WHERE nspname = 'public' AND
                      has_schema_privilege(oid, 'USAGE') AND has_schema_privilege(oid, 'CREATE')))"))
            return false;
        must(R"(CREATE TABLE public.layer_styles (id SERIAL PRIMARY KEY, f_table_catalog varchar,
                f_table_schema varchar, f_table_name varchar, f_geometry_column varchar, stylename text,
                styleqml xml, stylesld xml, useasdefault boolean, description text,
                owner varchar(63) DEFAULT CURRENT_USER, ui xml,
                update_time timestamp DEFAULT CURRENT_TIMESTAMP, type varchar))",
             "making the table of styles");
    }
    return holds("EXISTS (SELECT 1 " + std::string(style_table) +
                 R"( AND has_schema_privilege(n.oid, 'USAGE') AND has_table_privilege(c.oid, 'SELECT')
                     AND has_table_privilege(c.oid, 'INSERT') AND has_table_privilege(c.oid, 'DELETE')
                     AND NOT EXISTS (SELECT 1 FROM pg_depend d JOIN pg_class s ON s.oid = d.objid
                         WHERE d.refobjid = c.oid AND CASE WHEN s.relkind = 'S'
                             THEN NOT has_sequence_privilege(s.oid, 'USAGE') ELSE false END)
                     AND (SELECT count(*) FROM pg_attribute WHERE attrelid = c.oid AND attname IN
                         ('f_table_catalog', 'f_table_schema', 'f_table_name', 'f_geometry_column',
                          'stylename', 'styleqml', 'useasdefault', 'description')) = 8))");
}

void Furnishing::style() const {
    if (layer_.spec.style.title.empty() || layer_.geometry.empty() || !has_styles_of_qgis())
        return;
    const std::string of_layer =
        " FROM public.layer_styles WHERE f_table_catalog = current_database() AND f_table_schema = "
        "current_schema() AND f_table_name = " +
        sql_text(layer_.table);
    const char* doing = "writing the style";
    must("DELETE" + of_layer + " AND position(" + sql_text(std::string(style_mark)) +
             " in styleqml::text) > 0",
         doing);
    must(
        "INSERT INTO public.layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, "
        "stylename, styleqml, useasdefault, description) SELECT current_database(), current_schema(), " +
            sql_text(layer_.table) + ", " + sql_text(layer_.geometry) +
            ", 'dem2buildings', XMLPARSE(DOCUMENT " + sql_text(qml_style(layer_.spec, layer_.columns)) +
            "), NOT EXISTS (SELECT 1" + of_layer + " AND useasdefault), " + sql_text(layer_.spec.style.title),
        doing);
}

}  // namespace

void furnish_postgresql_table(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target) {
    const Furnishing furnishing(dataset, layer, target);
    furnishing.comment();
    furnishing.make_indices();
    furnishing.style();
}

}  // namespace d2b
