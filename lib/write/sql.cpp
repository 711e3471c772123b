#include "write/sql.hpp"

#include <cstddef>

#include "read/gdal_messages.hpp"

namespace d2b::writing {

namespace {

std::string quoted(const std::string& text, char quote) {
    std::string result(1, quote);
    for (const char c : text)
        result.append(c == quote ? 2 : 1, c);
    return result + quote;
}

int veto_commit(void* rolled_back) {
    return *static_cast<bool*>(rolled_back) ? 1 : 0;
}

void on_rollback(void* rolled_back) {
    *static_cast<bool*>(rolled_back) = true;
}

}  // namespace

std::string sql_identifier(const std::string& name) {
    return quoted(name, '"');
}

std::string sql_literal(const std::string& text) {
    return quoted(text, '\'');
}

bool sql_query(GDALDatasetH dataset, const std::string& sql, const std::function<void(const SqlRow&)>& use) {
    OGRLayerH rows = GDALDatasetExecuteSQL(dataset, sql.c_str(), nullptr, nullptr);
    if (rows == nullptr)
        return false;
    while (const reading::FeatureOwner row{OGR_L_GetNextFeature(rows)}) {
        const int fields = OGR_F_GetFieldCount(row.get());
        SqlRow texts;
        texts.reserve(static_cast<std::size_t>(fields));
        for (int i = 0; i < fields; ++i)
            texts.emplace_back(OGR_F_GetFieldAsString(row.get(), i));
        use(texts);
    }
    GDALDatasetReleaseResultSet(dataset, rows);
    return true;
}

std::optional<std::string> sql_value(GDALDatasetH dataset, const std::string& sql) {
    std::optional<std::string> value;
    sql_query(dataset, sql, [&](const SqlRow& row) {
        if (!value && !row.empty())
            value = row[0];
    });
    return value;
}

void sql_run(GDALDatasetH dataset, const std::string& sql) {
    if (OGRLayerH rows = GDALDatasetExecuteSQL(dataset, sql.c_str(), nullptr, nullptr))
        GDALDatasetReleaseResultSet(dataset, rows);
}

void sql_run_or_throw(GDALDatasetH dataset, const WriteTarget& target, const std::string& sql,
                      const std::string& doing) {
    OgrCall call(target);
    sql_run(dataset, sql);
    call.check(true, doing);
}

bool sql_succeeds(GDALDatasetH dataset, const std::string& sql) {
    const reading::GdalMessages messages;
    sql_run(dataset, sql);
    return !messages.failed();
}

sqlite3* sqlite_handle(GDALDatasetH dataset) {
    const reading::GdalMessages quiet;
    auto* handle = static_cast<sqlite3*>(GDALGetInternalHandle(dataset, "SQLITE_HANDLE"));
    const bool ours =
        handle != nullptr && sql_value(dataset, "SELECT sqlite_source_id()") == sqlite3_sourceid();
    return ours ? handle : nullptr;
}

void CommitGuard::watch(GDALDatasetH dataset) {
    sqlite3* const handle = sqlite_handle(dataset);
    if (handle == nullptr)
        return;
    sqlite3_rollback_hook(handle, on_rollback, &rolled_back_);
    sqlite3_commit_hook(handle, veto_commit, &rolled_back_);
}

}  // namespace d2b::writing
