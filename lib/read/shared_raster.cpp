#include "read/shared_raster.hpp"

#include <vector>

#include "read/column_readers.hpp"
#include "read/mosaic_columns.hpp"
#include "read/reader_pool.hpp"

namespace d2b {

std::unique_ptr<SharedRaster> share_raster(OpenRaster raster, const ReadOptions& options, std::string path,
                                           const DemInfo& info, Warnings& warnings) {
    std::vector<std::int32_t> ends = ends_of_columns(raster.dataset.get(), options.band);
    if (ends.size() > 1)
        return std::make_unique<ColumnReaders>(std::move(raster), options, std::move(path), info, warnings,
                                               std::move(ends));
    return std::make_unique<ReaderPool>(std::move(raster), options, std::move(path), info, warnings);
}

}  // namespace d2b
