#pragma once

#include <span>
#include <string>
#include <vector>

#include "write/ogr_util.hpp"

namespace d2b::writing {

/// Removes the database name of some tables from a statement of SQLite: `main.buildings`, with any quotes,
/// becomes `buildings`, which refers to a temporary table if there is one.
[[nodiscard]] std::string strip_database_name(const std::string& sql, std::span<const std::string> tables);

/// Objects of users that depend on layers of a SQLite database (GeoPackage), kept while the layers are
/// replaced: triggers and indices are dropped with a table and recreated, views must match the new table.
class DependentObjects {
  public:
    /// @param layers to be replaced
    DependentObjects(GDALDatasetH dataset, std::vector<std::string> layers);

    [[nodiscard]] bool empty() const { return dropped_with_tables_.empty() && views_.empty(); }
    /// Creates the new layers, empty, and the dependent objects in the temporary database of this connection,
    /// which shadows the main one and is discarded with it, so nothing is written. @param tables statements
    /// that create the layers @throws OutputError naming the object that does not match
    void preflight(const WriteTarget& target, const std::vector<std::string>& tables) const;
    /// Recreates the objects in the same transaction after the new layers are written. @throws OutputError
    /// naming the object that does not match
    void recreate(const WriteTarget& target) const;

  private:
    struct Object {
        std::string type;
        std::string name;
        std::string sql;
    };
    void require_fit(const WriteTarget& target) const;
    /// @param what object in question, for messages @throws OutputError if the database rejects a statement
    void require(const WriteTarget& target, const std::string& sql, const std::string& what) const;

    GDALDatasetH dataset_;
    std::vector<std::string> layers_;
    std::vector<Object> dropped_with_tables_;
    std::vector<Object> views_;  ///< readable views
};

}  // namespace d2b::writing
