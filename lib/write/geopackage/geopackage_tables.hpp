#pragma once

#include "write/ogr_util.hpp"
#include "write/qgis/qgis_style.hpp"

namespace d2b::writing {

/// Adds rows about a layer to a GeoPackage in the open transaction: its default style in the table
/// layer_styles of QGIS, title, abstract and lineage as QGIS metadata, and names, units and descriptions of
/// its fields in gpkg_data_columns. Leaves rows of others alone: a default style chosen by the user stays the
/// default, and a table layer_styles with other columns gets no row. @throws OutputError
void write_geopackage_tables(GDALDatasetH dataset, const NewLayer& layer, const Provenance& provenance,
                             const WriteTarget& target);

/// Replaces our items in the metadata of the file as a whole, if it has some, and keeps those of others. By
/// SQL, because GDAL 3.6 reads the items again before it writes them, and then keeps old values. @throws
/// OutputError
void replace_dataset_metadata(GDALDatasetH dataset, const Provenance& provenance, const WriteTarget& target);

}  // namespace d2b::writing
