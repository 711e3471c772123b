#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "read/shared_raster.hpp"

namespace d2b {

/// Mosaic that several threads read concurrently. It is opened once per column of rasters, and only one
/// thread at a time reads a column; a thread that finds a column locked takes another one first. No block is
/// therefore decoded twice.
class ColumnReaders final : public SharedRaster {
  public:
    /// @param ends right ends of the columns. They cut no raster: see ends_of_columns()
    ColumnReaders(OpenRaster raster, const ReadOptions& options, std::string path, const DemInfo& info,
                  Warnings& warnings, const std::vector<std::int32_t>& ends);

    void read(const Window& part, std::span<double> elevations) override;

  private:
    /// Range of cell columns.
    struct Column {
        std::int32_t begin = 0;
        std::int32_t end = 0;
        std::mutex at_work{};
        /// Null until it is read, or if it cannot be opened again.
        std::unique_ptr<RasterReader> reader{};
        std::vector<double> values{};
    };
    void read(Column& column, const Window& part, std::span<double> elevations);
    void read(Column& column, RasterReader& reader, const Window& part, std::span<double> elevations);
    /// Returns null if the mosaic cannot be opened again.
    [[nodiscard]] std::unique_ptr<RasterReader> reopen() const;

    ReadOptions options_;
    std::string path_;
    DemInfo info_;
    Warnings& warnings_;
    std::deque<Column> columns_;
};

}  // namespace d2b
