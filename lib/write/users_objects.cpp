#include "write/users_objects.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"
#include "write/without_database.hpp"

namespace d2b {

namespace {

/// True for triggers that GDAL and SpatiaLite create and recreate.
bool is_drivers_own(const std::string& name, const std::string& layer) {
    static constexpr std::array prefixes{"ggi_", "ggu_", "gii_", "giu_", "gid_", "tmi_", "tmu_", "tmd_"};
    return name.starts_with("rtree_" + layer + "_") || name == "trigger_insert_feature_count_" + layer ||
           name == "trigger_delete_feature_count_" + layer ||
           std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const char* prefix) { return name.starts_with(prefix + layer + "_"); });
}

/// Returns the error of a statement; "" if there is none.
std::string objection(GDALDatasetH dataset, const std::string& sql) {
    const GdalMessages messages;
    sql_run(dataset, sql);
    if (!messages.failed())
        return "";
    // GDAL prepends the statement to the message of SQLite.
    const std::string reason = messages.first_reason();
    const std::size_t statement = reason.find(sql);
    const std::size_t colon =
        statement == std::string::npos ? statement : reason.find(": ", statement + sql.size());
    return colon == std::string::npos ? reason : reason.substr(colon + 2);
}

bool is_there(GDALDatasetH dataset, const std::string& type, const std::string& name) {
    return sql_value(dataset, "SELECT 1 FROM sqlite_master WHERE type = " + sql_text(type) +
                                  " AND name = " + sql_text(name))
        .has_value();
}

std::string view_query(const std::string& view) {
    return "SELECT * FROM " + sql_name(view) + " LIMIT 0";
}

/// Rewrites a CREATE statement, which sqlite_master stores with a normalized begin, for the temporary
/// database. Names there take precedence over those of the main database.
std::string temporary(const std::string& type, const std::string& sql) {
    const std::size_t word = sql.find(type == "index" ? "INDEX " : " ");
    return type == "index" ? std::string(sql).insert(word + 6, "temp.")
                           : std::string(sql).insert(word, " TEMP");
}

}  // namespace

UsersObjects::UsersObjects(GDALDatasetH dataset, std::vector<std::string> layers)
    : dataset_(dataset), layers_(std::move(layers)) {
    const GdalMessages quiet;
    // Make GDAL read the columns of all layers now, because those of a view cannot be read while its tables
    // are being replaced.
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
    sql_query(dataset_, "SELECT name, sql FROM sqlite_master WHERE type = 'view' ORDER BY rowid",
              [&](const SqlRow& row) {
                  views_.push_back({"view", row[0], row[1]});
              });
    std::erase_if(views_,
                  [&](const Object& view) { return !objection(dataset_, view_query(view.name)).empty(); });
}

void UsersObjects::rehearse(const WriteTarget& target, const std::vector<std::string>& tables) const {
    const GdalMessages quiet;
    for (const std::string& table : tables)
        require(target, temporary("table", table), "layer");
    for (const Object& view : views_)
        require(target, without_database(temporary("view", view.sql), layers_),
                view.type + " \"" + view.name + "\"");
    for (const Object& object : gone_with_tables_)
        require(target, without_database(temporary(object.type, object.sql), layers_),
                object.type + " \"" + object.name + "\"");
    require_fit(target);
}

void UsersObjects::bring_back(const WriteTarget& target) const {
    for (const Object& object : gone_with_tables_)
        if (!is_there(dataset_, object.type, object.name))
            require(target, object.sql, object.type + " \"" + object.name + "\"");
    require_fit(target);
}

void UsersObjects::require_fit(const WriteTarget& target) const {
    // SQLite checks the body of a trigger only when it is first prepared, so EXPLAIN each statement that
    // fires it.
    for (const Object& object : gone_with_tables_)
        if (object.type == "trigger")
            for (const std::string& layer : layers_)
                for (const char* sql : {"EXPLAIN INSERT INTO @ DEFAULT VALUES", "EXPLAIN DELETE FROM @",
                                        "EXPLAIN UPDATE @ SET rowid = rowid"}) {
                    std::string text = sql;
                    require(target, text.replace(text.find('@'), 1, sql_name(layer)),
                            object.type + " \"" + object.name + "\"");
                }
    for (const Object& view : views_)
        require(target, view_query(view.name), view.type + " \"" + view.name + "\"");
}

void UsersObjects::require(const WriteTarget& target, const std::string& sql, const std::string& what) const {
    const std::string reason = objection(dataset_, sql);
    if (!reason.empty())
        throw OutputError("Cannot write \"" + target.name + "\": its " + what +
                          " does not fit the new layers (" + reason +
                          "); remove it first, or write to another destination.");
}

}  // namespace d2b
