#include "write/geopackage/geopackage_tables.hpp"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <gdal_version.h>

#include "write/sql.hpp"

namespace d2b::writing {

namespace {

constexpr const char* our_name = "'dem2buildings'";

/// SQL for the current time, or the value of OGR_CURRENT_DATE, which the tables of GDAL follow too.
std::string now() {
    const char* given = CPLGetConfigOption("OGR_CURRENT_DATE", nullptr);
    return given != nullptr ? sql_literal(given) : "strftime('%Y-%m-%dT%H:%M:%fZ','now')";
}

bool has_table(GDALDatasetH dataset, const std::string& name) {
    const reading::GdalMessages quiet;
    return sql_value(dataset, "SELECT 1 FROM sqlite_master WHERE lower(name) = " + sql_literal(name))
        .has_value();
}

/// Uses plain SQL, because the driver would write to a table that it knows even after a rollback.
class GeopackageTables {
  public:
    GeopackageTables(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target)
        : dataset_(dataset), layer_(layer), target_(target), table_(sql_literal(layer.table)) {}

    void style() const;
    void metadata(const Provenance& provenance) const;
    void data_columns() const;

  private:
    void run_or_throw(const std::string& sql, const char* doing) const {
        sql_run_or_throw(dataset_, target_, sql, doing);
    }
    void make_style_table() const;
    [[nodiscard]] bool has_styles_of_qgis() const;

    GDALDatasetH dataset_;
    const NewLayer& layer_;
    const WriteTarget& target_;
    std::string table_;
};

/// Same columns as the table that QGIS creates.
void GeopackageTables::make_style_table() const {
    const char* doing = "creating the table of styles";
    run_or_throw(
        "CREATE TABLE \"layer_styles\" ( \"id\" INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, "
        "\"f_table_catalog\" TEXT(256), \"f_table_schema\" TEXT(256), \"f_table_name\" TEXT(256), "
        "\"f_geometry_column\" TEXT(256), \"styleName\" TEXT(30), \"styleQML\" TEXT, \"styleSLD\" TEXT, "
        "\"useAsDefault\" BOOLEAN, \"description\" TEXT, \"owner\" TEXT(30), \"ui\" TEXT(30), "
        "\"update_time\" DATETIME DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')))",
        doing);
    run_or_throw(
        "INSERT INTO gpkg_contents (table_name, data_type, identifier, description, last_change, srs_id) "
        "VALUES ('layer_styles', 'attributes', 'layer_styles', '', " +
            now() + ", 0)",
        doing);
}

bool GeopackageTables::has_styles_of_qgis() const {
    OgrCall call(target_);
    const auto columns = sql_value(
        dataset_,
        "SELECT COUNT(*) FROM pragma_table_info('layer_styles') WHERE name IN ('f_table_catalog', "
        "'f_table_schema', 'f_table_name', 'f_geometry_column', 'styleName', 'styleQML', 'styleSLD', "
        "'useAsDefault', 'description', 'owner', 'update_time')");
    call.check(columns.has_value(), "reading the table of styles");
    return *columns == "11";
}

void GeopackageTables::style() const {
    if (layer_.spec.style.title.empty())
        return;
    if (!has_table(dataset_, "layer_styles"))
        make_style_table();
    // A table with other columns belongs to another program.
    if (!has_styles_of_qgis())
        return;
    const char* doing = "writing the style";
    const std::string of_layer = " FROM layer_styles WHERE lower(f_table_name) = lower(" + table_ + ")";
    // Also those that this run does not write again.
    std::string names;
    for (const std::string_view name : {default_style_name, sun_style_name, quantile_style_name})
        names += (names.empty() ? "" : ", ") + sql_literal(std::string(name));
    run_or_throw("DELETE" + of_layer + " AND styleName IN (" + names + ") AND owner = " + our_name, doing);
    for (const NamedStyle& style : qml_styles(layer_)) {
        const std::string name = sql_literal(style.name);
        run_or_throw(
            "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, "
            "styleName, styleQML, styleSLD, useAsDefault, description, owner, update_time) VALUES ('', '', " +
                table_ + ", " + sql_literal(layer_.geometry) + ", " + name + ", " + sql_literal(style.qml) +
                ", '', NOT EXISTS (SELECT 1" + of_layer + " AND useAsDefault), " + sql_literal(style.title) +
                ", " + our_name + ", " + now() + ")",
            doing);
    }
}

void GeopackageTables::metadata(const Provenance& provenance) const {
    // GDAL creates the tables with its own metadata; without any there is no lineage either.
    if (!has_table(dataset_, "gpkg_metadata"))
        return;
    const char* doing = "writing the metadata";
    run_or_throw(
        "INSERT INTO gpkg_metadata (md_scope, md_standard_uri, mime_type, metadata) VALUES ('dataset', "
        "'http://mrcc.com/qgis.dtd', 'text/xml', " +
            sql_literal(qgis_metadata(layer_.spec, provenance)) + ")",
        doing);
    run_or_throw(
        "INSERT INTO gpkg_metadata_reference (reference_scope, table_name, timestamp, md_file_id) SELECT "
        "'table', " +
            table_ + ", " + now() + ", max(id) FROM gpkg_metadata",
        doing);
}

void GeopackageTables::data_columns() const {
#if GDAL_VERSION_NUM < GDAL_COMPUTE_VERSION(3, 7, 0)
    const char* doing = "describing the fields";
    const auto add_table = [&](const std::string& name, const char* columns) {
        if (has_table(dataset_, name))
            return;
        run_or_throw("CREATE TABLE " + name + " (" + columns + ")", doing);
        run_or_throw(
            "INSERT INTO gpkg_extensions (table_name, column_name, extension_name, definition, scope) "
            "VALUES ('" +
                name +
                "', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec121/#extension_schema', "
                "'read-write')",
            doing);
    };
    add_table(
        "gpkg_data_columns",
        "table_name TEXT NOT NULL, column_name TEXT NOT NULL, name TEXT, title TEXT, description TEXT, "
        "mime_type TEXT, constraint_name TEXT, CONSTRAINT pk_gdc PRIMARY KEY (table_name, column_name), "
        "CONSTRAINT gdc_tn UNIQUE (table_name, name)");
    add_table("gpkg_data_column_constraints",
              "constraint_name TEXT NOT NULL, constraint_type TEXT NOT NULL, value TEXT, min NUMERIC, "
              "min_is_inclusive BOOLEAN, max NUMERIC, max_is_inclusive BOOLEAN, description TEXT, CONSTRAINT "
              "gdcc_ntv UNIQUE (constraint_name, constraint_type, value)");
    run_or_throw("DELETE FROM gpkg_data_columns WHERE lower(table_name) = lower(" + table_ + ")", doing);
    std::string rows;
    for (std::size_t i = 0; i < layer_.columns.size(); ++i) {
        const FieldSpec& field = layer_.spec.fields[i];
        rows += (rows.empty() ? "(" : ", (") + table_ + ", " + sql_literal(layer_.columns[i]) + ", " +
                sql_literal(field.alias) + ", " + sql_literal(field.description) + ")";
    }
    // Leaves out `name`, because it must be unique, while two fields may have the same alias.
    run_or_throw("INSERT INTO gpkg_data_columns (table_name, column_name, title, description) VALUES " + rows,
                 doing);
#endif
}

}  // namespace

void replace_dataset_metadata(GDALDatasetH dataset, const Provenance& provenance, const WriteTarget& target) {
    if (!has_table(dataset, "gpkg_metadata"))
        return;
    const std::string row =
        "(SELECT md.id FROM gpkg_metadata md JOIN gpkg_metadata_reference mdr ON md.id = mdr.md_file_id "
        "WHERE mdr.reference_scope = 'geopackage' AND md.md_standard_uri = 'http://gdal.org' AND "
        "md.mime_type = 'text/xml' LIMIT 1)";
    const auto text = sql_value(dataset, "SELECT metadata FROM gpkg_metadata WHERE id = " + row);
    const reading::GdalOwner<CPLXMLNode*, CPLDestroyXMLNode> tree(text ? CPLParseXMLString(text->c_str())
                                                                       : nullptr);
    CPLXMLNode* const items = tree ? CPLGetXMLNode(tree.get(), "Metadata") : nullptr;
    if (items == nullptr || CPLGetXMLValue(items, "domain", nullptr) != nullptr)
        return;
    for (CPLXMLNode* item = items->psChild; item != nullptr;) {
        CPLXMLNode* const next = item->psNext;
        const std::string name = CPLGetXMLValue(item, "key", "");
        if (name.starts_with("D2B_") || provenance.metadata.contains(name)) {
            CPLRemoveXMLChild(items, item);
            CPLDestroyXMLNode(item);
        }
        item = next;
    }
    for (const auto& [name, value] : provenance.metadata) {
        CPLXMLNode* const item = CPLCreateXMLNode(items, CXT_Element, "MDI");
        CPLAddXMLAttributeAndValue(item, "key", name.c_str());
        CPLCreateXMLNode(item, CXT_Text, value.c_str());
    }
    const std::unique_ptr<char, reading::GdalRelease<void*, VSIFree>> made(CPLSerializeXMLTree(tree.get()));
    sql_run_or_throw(dataset, target,
                     "UPDATE gpkg_metadata SET metadata = " + sql_literal(made.get()) + " WHERE id = " + row,
                     "writing the metadata");
}

void write_geopackage_tables(GDALDatasetH dataset, const NewLayer& layer, const Provenance& provenance,
                             const WriteTarget& target) {
    const GeopackageTables tables(dataset, layer, target);
    tables.style();
    tables.metadata(provenance);
    tables.data_columns();
}

}  // namespace d2b::writing
