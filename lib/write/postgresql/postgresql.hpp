#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/ogr_util.hpp"
#include "write/qgis/qgis_style.hpp"

namespace d2b::writing {

/// Reports errors that would otherwise occur after all the work: no PostGIS, no such schema, a user without
/// the rights to create, replace or append to the layers. @param names of the layers @throws OptionError,
/// OutputError
void check_postgresql(const Destination& destination, GDALDatasetH database, const WriteOptions& options,
                      const std::vector<std::string>& names);

/// @param reason why it cannot be opened @throws OutputError always
[[noreturn]] void throw_unreachable_postgresql(const Destination& destination, const std::string& reason);

/// Completes the table of a new layer in PostgreSQL in the open transaction: a comment per column, which QGIS
/// shows, a unique index of ids and an index by which the parts of a building are found. The driver creates
/// the spatial index. @throws OutputError
void complete_postgresql_table(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target);

}  // namespace d2b::writing
