#pragma once

#include <string>
#include <vector>

#include "write/ogr_call.hpp"

namespace d2b {

/// What a user has made on layers in a SQLite database (GeoPackage), and what becomes of it where they are
/// replaced: triggers and indices go with a table and are made again, views must fit the new one.
class UsersObjects {
  public:
    /// @param layers that are to be replaced
    UsersObjects(GDALDatasetH dataset, std::vector<std::string> layers);

    [[nodiscard]] bool empty() const { return gone_with_tables_.empty() && views_.empty(); }
    /// Makes the new layers, empty, and what the user has made of them, in the temporary database of this
    /// connection, which covers the other one and goes with it: nothing is written.
    /// @param tables statements that make the layers @throws OutputError with the name of what does not fit
    /// them
    void rehearse(const WriteTarget& target, const std::vector<std::string>& tables) const;
    /// Once the new layers are written, within the same transaction. @throws OutputError with the name of
    /// what does not fit them
    void bring_back(const WriteTarget& target) const;

  private:
    struct Object {
        std::string type;
        std::string name;
        std::string sql;
    };
    void require_fit(const WriteTarget& target) const;
    /// @param what of the user's is in question @throws OutputError where the database refuses a statement
    void require(const WriteTarget& target, const std::string& sql, const std::string& what) const;

    GDALDatasetH dataset_;
    std::vector<std::string> layers_;
    std::vector<Object> gone_with_tables_;
    std::vector<Object> views_;  ///< those that can be read
};

}  // namespace d2b
