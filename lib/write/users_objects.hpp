#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/ogr_call.hpp"

namespace d2b {

/// What a user has made on layers in a SQLite database (GeoPackage), and what becomes of it where they are
/// replaced: triggers and indices go with a table and are made again, views must fit the new one.
class UsersObjects {
  public:
    /// @param layers that are to be replaced
    UsersObjects(GDALDatasetH dataset, std::vector<std::string> layers);

    /// Once the new layers are written, within the same transaction. @throws OutputError with the name of
    /// what does not fit them
    void bring_back(const WriteTarget& target) const;

  private:
    struct Object {
        std::string type;
        std::string name;
        std::string sql;
    };
    GDALDatasetH dataset_;
    std::vector<std::string> layers_;
    std::vector<Object> gone_with_tables_;
    std::vector<std::string> views_;  ///< those that can be read
};

/// For what would break where layers are replaced: relations and foreign keys, whose numbers would mean other
/// features; in PostgreSQL views and triggers, too, which it drops. @param names of the layers
/// @throws OptionError with the name of the first
void refuse_what_would_break(const Destination& destination, GDALDatasetH dataset, const VectorFormat& format,
                             const std::vector<std::string>& names);

}  // namespace d2b
