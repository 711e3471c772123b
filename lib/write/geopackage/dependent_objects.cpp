#include "write/geopackage/dependent_objects.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

#include <cpl_string.h>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"

namespace d2b::writing {

namespace {

struct Token {
    std::string text;     ///< without quotes
    std::size_t end = 0;  ///< end in the statement; the begin if there is none
};

bool is_identifier_char(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$' ||
           static_cast<unsigned char>(c) >= 128;
}

/// Returns the name, number or text at a position; quoted text is one token.
Token token_at(const std::string& sql, std::size_t at) {
    if (at >= sql.size())
        return {"", at};
    const char open = sql[at];
    if (open == '"' || open == '`' || open == '\'' || open == '[') {
        const char close = open == '[' ? ']' : open;
        Token name{"", at + 1};
        for (; name.end < sql.size(); ++name.end) {
            if (sql[name.end] == close && (open == '[' || sql[name.end + 1] != close))
                break;
            if (sql[name.end] == close)
                ++name.end;
            name.text += sql[name.end];
        }
        name.end = std::min(name.end + 1, sql.size());
        return name;
    }
    Token name{"", at};
    while (name.end < sql.size() && is_identifier_char(sql[name.end]))
        name.text += sql[name.end++];
    return name;
}

std::size_t skip_spaces(const std::string& sql, std::size_t at) {
    while (at < sql.size() && std::isspace(static_cast<unsigned char>(sql[at])) != 0)
        ++at;
    return at;
}

/// True for triggers that GDAL and SpatiaLite create and recreate.
bool is_created_by_driver(const std::string& name, const std::string& layer) {
    static constexpr std::array prefixes{"ggi_", "ggu_", "gii_", "giu_", "gid_", "tmi_", "tmu_", "tmd_"};
    return name.starts_with("rtree_" + layer + "_") || name == "trigger_insert_feature_count_" + layer ||
           name == "trigger_delete_feature_count_" + layer ||
           std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const char* prefix) { return name.starts_with(prefix + layer + "_"); });
}

/// Returns the error of a statement; "" if there is none.
std::string sql_error(GDALDatasetH dataset, const std::string& sql) {
    const reading::GdalMessages messages;
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
    return sql_value(dataset, "SELECT 1 FROM sqlite_master WHERE type = " + sql_literal(type) +
                                  " AND name = " + sql_literal(name))
        .has_value();
}

std::string view_query(const std::string& view) {
    return "SELECT * FROM " + sql_identifier(view) + " LIMIT 0";
}

/// Rewrites a CREATE statement, which sqlite_master stores with a normalized begin, for the temporary
/// database. Names there take precedence over those of the main database.
std::string in_temp_database(const std::string& type, const std::string& sql) {
    const std::size_t word = sql.find(type == "index" ? "INDEX " : " ");
    return type == "index" ? std::string(sql).insert(word + 6, "temp.")
                           : std::string(sql).insert(word, " TEMP");
}

}  // namespace

std::string strip_database_name(const std::string& sql, std::span<const std::string> tables) {
    std::string bare;
    for (std::size_t at = 0; at < sql.size();) {
        const Token name = token_at(sql, at);
        const std::size_t dot = skip_spaces(sql, name.end);
        if (EQUAL(name.text.c_str(), "main") && dot < sql.size() && sql[dot] == '.') {
            const std::size_t next = skip_spaces(sql, dot + 1);
            const std::string table = token_at(sql, next).text;
            if (std::any_of(tables.begin(), tables.end(),
                            [&](const std::string& each) { return EQUAL(each.c_str(), table.c_str()); })) {
                at = next;
                continue;
            }
        }
        const std::size_t end = std::max(name.end, at + 1);
        bare.append(sql, at, end - at);
        at = end;
    }
    return bare;
}

DependentObjects::DependentObjects(GDALDatasetH dataset, std::vector<std::string> layers)
    : dataset_(dataset), layers_(std::move(layers)) {
    const reading::GdalMessages quiet;
    // Make GDAL read the columns of all layers now, because those of a view cannot be read while its tables
    // are being replaced.
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i)
        OGR_L_GetLayerDefn(GDALDatasetGetLayer(dataset_, i));
    for (const std::string& layer : layers_)
        sql_query(
            dataset_,
            "SELECT type, name, sql FROM sqlite_master WHERE type IN ('trigger', 'index') AND sql IS NOT "
            "NULL AND lower(tbl_name) = lower(" +
                sql_literal(layer) + ") ORDER BY rowid",
            [&](const SqlRow& row) {
                if (!is_created_by_driver(row[1], layer))
                    dropped_with_tables_.push_back({row[0], row[1], row[2]});
            });
    sql_query(dataset_, "SELECT name, sql FROM sqlite_master WHERE type = 'view' ORDER BY rowid",
              [&](const SqlRow& row) {
                  views_.push_back({"view", row[0], row[1]});
              });
    std::erase_if(views_,
                  [&](const Object& view) { return !sql_error(dataset_, view_query(view.name)).empty(); });
}

void DependentObjects::preflight(const WriteTarget& target, const std::vector<std::string>& tables) const {
    const reading::GdalMessages quiet;
    for (const std::string& table : tables)
        require(target, in_temp_database("table", table), "layer");
    for (const Object& view : views_)
        require(target, strip_database_name(in_temp_database("view", view.sql), layers_),
                view.type + " \"" + view.name + "\"");
    for (const Object& object : dropped_with_tables_)
        require(target, strip_database_name(in_temp_database(object.type, object.sql), layers_),
                object.type + " \"" + object.name + "\"");
    require_fit(target);
}

void DependentObjects::recreate(const WriteTarget& target) const {
    for (const Object& object : dropped_with_tables_)
        if (!is_there(dataset_, object.type, object.name))
            require(target, object.sql, object.type + " \"" + object.name + "\"");
    require_fit(target);
}

void DependentObjects::require_fit(const WriteTarget& target) const {
    // SQLite checks the body of a trigger only when it is first prepared, so EXPLAIN each statement that
    // fires it.
    for (const Object& object : dropped_with_tables_)
        if (object.type == "trigger")
            for (const std::string& layer : layers_)
                for (const char* sql : {"EXPLAIN INSERT INTO @ DEFAULT VALUES", "EXPLAIN DELETE FROM @",
                                        "EXPLAIN UPDATE @ SET rowid = rowid"}) {
                    std::string text = sql;
                    require(target, text.replace(text.find('@'), 1, sql_identifier(layer)),
                            object.type + " \"" + object.name + "\"");
                }
    for (const Object& view : views_)
        require(target, view_query(view.name), view.type + " \"" + view.name + "\"");
}

void DependentObjects::require(const WriteTarget& target, const std::string& sql,
                               const std::string& what) const {
    const std::string reason = sql_error(dataset_, sql);
    if (!reason.empty())
        throw OutputError("Cannot write \"" + target.name + "\": its " + what +
                          " does not fit the new layers (" + reason +
                          "); remove it first, or write to another destination.");
}

}  // namespace d2b::writing
