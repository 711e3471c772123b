#pragma once

#include <map>
#include <sqlite3.h>
#include <string>

#include <gtest/gtest.h>

#include "faults/faulty_case.hpp"

namespace d2b::test {

/// All that a database holds: the text of each table, index and trigger, and each row of each table, bytes
/// included. "" where there is none; fails the test where it cannot be read.
inline std::string database_content(const std::string& path) {
    if (!std::filesystem::exists(path))
        return "";
    sqlite3* database = nullptr;
    std::string content;
    const auto gather = [&](const std::string& sql, const auto& use) {
        sqlite3_stmt* rows = nullptr;
        EXPECT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &rows, nullptr), SQLITE_OK)
            << sql << ": " << sqlite3_errmsg(database);
        while (sqlite3_step(rows) == SQLITE_ROW) {
            std::vector<std::string> values;
            for (int i = 0; i < sqlite3_column_count(rows); ++i) {
                const auto* bytes = static_cast<const char*>(sqlite3_column_blob(rows, i));
                values.emplace_back(bytes == nullptr ? "" : bytes,
                                    static_cast<std::size_t>(sqlite3_column_bytes(rows, i)));
            }
            use(values);
        }
        EXPECT_EQ(sqlite3_finalize(rows), SQLITE_OK) << sql;
    };
    EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr), SQLITE_OK);
    std::vector<std::string> tables;
    gather("SELECT type, name, sql FROM sqlite_master ORDER BY name", [&](const auto& row) {
        content += row[0] + ' ' + row[1] + ' ' + row[2] + '\n';
        if (row[0] == "table" && row[2].find("VIRTUAL TABLE") == std::string::npos)
            tables.push_back(row[1]);
    });
    for (const std::string& table : tables)
        gather("SELECT * FROM \"" + table + '"', [&](const auto& row) {
            content += table;
            for (const std::string& value : row)
                content += '|' + value;
            content += '\n';
        });
    sqlite3_close(database);
    return content;
}

inline void run_sql(const std::string& path, const std::string& statements) {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
}

/// The bytes of a file, but for the day on which a .dbf says that it was written.
inline std::string bytes_of(const std::filesystem::path& path) {
    std::string bytes = read_bytes(path.string());
    if (path.extension() == ".dbf" && bytes.size() > 4)
        bytes.replace(1, 3, "day");
    return bytes;
}

/// Files of a folder that are not hidden, with their bytes.
inline std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.is_regular_file())
                files[entry.path().filename().string()] = bytes_of(entry.path());
    return files;
}

}  // namespace d2b::test
