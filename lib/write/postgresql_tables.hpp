#pragma once

#include "write/new_layer.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// What stands beside the rows of a new layer in PostgreSQL, in the transaction that is open: a comment on
/// each column, which QGIS shows, numbers that are given once, and an index by which the parts of a building
/// are found. The driver makes the index of geometries. @throws OutputError
void furnish_postgresql_table(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target);

}  // namespace d2b
