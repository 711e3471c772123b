#pragma once

#include <string>
#include <vector>

#include "dem2buildings/feature_sink.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// A layer that a run has made.
struct NewLayer {
    const LayerSpec& spec;
    std::string table;                 ///< as the driver calls it
    std::string geometry;              ///< its column
    std::vector<std::string> columns;  ///< of each field of the spec
};

/// Rows beside a layer of a GeoPackage, in the transaction that is open: its default style in QGIS's table
/// layer_styles, title, abstract and lineage as metadata of QGIS's kind, and names, units and words of its
/// fields in gpkg_data_columns. Rows of others are left alone: a style that the user has made the default
/// stays it, and a table layer_styles of another shape gets no row.
/// @throws OutputError
void write_tables(GDALDatasetH dataset, const NewLayer& layer, const Provenance& provenance,
                  const WriteTarget& target);

}  // namespace d2b
