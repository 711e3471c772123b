#include "read/shared_raster.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/georeferencing.hpp"

namespace d2b::reading {

namespace {

using XmlOwner = GdalOwner<CPLXMLNode*, CPLDestroyXMLNode>;

/// Parses the XML of a VRT. Returns null if the dataset is not a VRT or so large that a mosaic opened once is
/// better.
XmlOwner description_of(GDALDatasetH dataset) {
    constexpr vsi_l_offset most_bytes = vsi_l_offset{4} << 20;
    const GDALDriverH driver = GDALGetDatasetDriver(dataset);
    if (driver == nullptr || std::string_view(GDALGetDriverShortName(driver)) != "VRT")
        return nullptr;
    VSIStatBufL status{};
    if (VSIStatL(GDALGetDescription(dataset), &status) != 0 ||
        static_cast<vsi_l_offset>(status.st_size) > most_bytes)
        return nullptr;
    const CSLConstList all = GDALGetMetadata(dataset, "xml:VRT");
    return XmlOwner(all == nullptr || *all == nullptr ? nullptr : CPLParseXMLString(*all));
}

/// Returns the band with this number if it is a plain mosaic band.
const CPLXMLNode* band_of(const CPLXMLNode* vrt, int band) {
    const CPLXMLNode* root = CPLGetXMLNode(vrt, "=VRTDataset");
    for (const CPLXMLNode* node = root != nullptr ? root->psChild : nullptr; node != nullptr;
         node = node->psNext)
        if (std::string_view(node->pszValue) == "VRTRasterBand" && --band == 0)
            return CPLGetXMLValue(node, "subClass", nullptr) == nullptr ? node : nullptr;
    return nullptr;
}

std::vector<ColumnSpan> rasters_of(const CPLXMLNode* band, std::int32_t cols) {
    std::vector<ColumnSpan> rasters;
    for (const CPLXMLNode* node = band->psChild; node != nullptr; node = node->psNext) {
        if (!std::string_view(node->pszValue).ends_with("Source"))
            continue;
        const auto number = [&](const char* name, double other) {
            const char* text = CPLGetXMLValue(node, name, nullptr);
            return text == nullptr ? other : CPLAtof(text);
        };
        const double first = number("DstRect.xOff", 0);
        const double end = first + number("DstRect.xSize", cols);
        const auto within = [&](double col) {
            return static_cast<std::int32_t>(std::clamp(col, 0.0, static_cast<double>(cols)));
        };
        const ColumnSpan span{within(std::floor(first)), within(std::ceil(end))};
        if (span[0] < span[1])
            rasters.push_back(span);
    }
    return rasters;
}

}  // namespace

std::vector<std::int32_t> divide_columns(std::vector<ColumnSpan> rasters, std::int32_t cols,
                                         const ColumnLimits& limits) {
    const std::size_t most = std::min(limits.max_columns, limits.max_rasters / (rasters.size() + 1));
    const std::int32_t least =
        std::max(limits.min_cells, most == 0 ? cols : cols / static_cast<std::int32_t>(most));
    std::ranges::sort(rasters);
    std::vector<std::int32_t> ends;
    std::int32_t begin = 0;
    std::int32_t covered = 0;  // by rasters that begin earlier
    for (const auto& [first, end] : rasters) {
        if (first >= covered && first - begin >= least && cols - first >= least)
            ends.push_back(begin = first);
        covered = std::max(covered, end);
    }
    ends.push_back(cols);
    return ends;
}

std::vector<std::int32_t> ends_of_columns(GDALDatasetH dataset, int band) {
    const std::int32_t cols = GDALGetRasterXSize(dataset);
    const XmlOwner vrt = description_of(dataset);
    const CPLXMLNode* const described = vrt == nullptr ? nullptr : band_of(vrt.get(), band);
    if (described == nullptr)
        return {cols};
    return divide_columns(rasters_of(described, cols), cols);
}

namespace {

/// Open raster for one thread at a time, because a GDAL dataset is not thread-safe.
struct RasterReader {
    RasterReader(OpenRaster raster, const ReadOptions& options, const DemInfo& info, Warnings& warnings)
        : source(std::move(raster)), bands(source.band, options, info, warnings) {}

    OpenRaster source;
    BandReader bands;
    std::int32_t block_row = -1;  ///< row of blocks that it decoded last and holds in its cache
};
using ReaderPtr = std::unique_ptr<RasterReader>;

/// Opens a raster again, for another thread.
struct RasterPlace {
    ReadOptions options;
    std::string path;
    DemInfo info;

    /// Returns null if the raster cannot be opened again.
    [[nodiscard]] ReaderPtr open() const {
        try {
            Warnings ignored;  // repeats warnings of the first opening
            return std::make_unique<RasterReader>(open_raster(options, path, ignored), options, info,
                                                  ignored);
        } catch (const Error&) {
            return nullptr;
        }
    }
};

/// Mosaic that several threads read concurrently. It is opened once per column of rasters, and only one
/// thread at a time reads a column; a thread that finds a column locked takes another one first. No block is
/// therefore decoded twice.
class ColumnReaders final : public ConcurrentRaster {
  public:
    /// @param ends right ends of the columns. They cut no raster: see ends_of_columns()
    ColumnReaders(ReaderPtr first, RasterPlace place, Warnings& warnings,
                  const std::vector<std::int32_t>& ends);

    void read(const Window& part, std::span<double> elevations) override;

  private:
    /// Range of cell columns.
    struct Column {
        std::int32_t begin = 0;
        std::int32_t end = 0;
        std::mutex mutex{};
        /// Null until it is read, or if it cannot be opened again.
        ReaderPtr reader{};
        std::vector<double> values{};
    };
    void read(Column& column, const Window& part, std::span<double> elevations);
    void read(Column& column, RasterReader& reader, const Window& part, std::span<double> elevations);

    RasterPlace place_;
    Warnings& warnings_;
    std::deque<Column> columns_;
};

/// Raster that several threads read concurrently. A GDAL dataset serves one thread at a time, so it is opened
/// again for threads that would have to wait, if that is cheap and safe; otherwise they wait. Threads that
/// need rows of the same blocks use the same reader in turn, so that no block is decoded twice.
class ReaderPool final : public ConcurrentRaster {
  public:
    ReaderPool(ReaderPtr first, RasterPlace place, Warnings& warnings);

    void read(const Window& part, std::span<double> elevations) override;

  private:
    class BlockRowLock;

    [[nodiscard]] ReaderPtr take(std::int32_t block_row);
    [[nodiscard]] ReaderPtr take_idle(std::int32_t block_row);

    RasterPlace place_;
    Warnings& warnings_;
    std::mutex mutex_;
    std::condition_variable returned_;
    bool may_reopen_;
    std::size_t readers_ = 1;
    std::vector<ReaderPtr> idle_;          ///< capacity for all readers
    std::vector<std::int32_t> busy_rows_;  ///< rows of blocks being decoded
};

ColumnReaders::ColumnReaders(ReaderPtr first, RasterPlace place, Warnings& warnings,
                             const std::vector<std::int32_t>& ends)
    : place_(std::move(place)), warnings_(warnings) {
    std::int32_t begin = 0;
    for (const std::int32_t end : ends) {
        Column& column = columns_.emplace_back();
        column.begin = std::exchange(begin, end);
        column.end = end;
    }
    columns_.front().reader = std::move(first);
}

void ColumnReaders::read(const Window& part, std::span<double> elevations) {
    require_part(place_.info, part, elevations.size());
    std::vector<Column*> left;
    for (Column& column : columns_)
        if (column.begin < part.end_col() && part.col < column.end)
            left.push_back(&column);
    while (!left.empty()) {
        auto next = std::ranges::find_if(left, [](Column* column) { return column->mutex.try_lock(); });
        if (next == left.end()) {
            next = left.begin();
            (*next)->mutex.lock();
        }
        const std::unique_lock<std::mutex> lock((*next)->mutex, std::adopt_lock);
        read(**next, part, elevations);
        left.erase(next);
    }
}

/// Reads the part that lies in a column. The caller holds the lock of the column.
void ColumnReaders::read(Column& column, const Window& part, std::span<double> elevations) {
    if (!column.reader)
        column.reader = place_.open();
    if (column.reader)
        return read(column, *column.reader, part, elevations);
    // Falls back on the first reader. A deadlock is impossible because a thread that holds the first column
    // waits for no other.
    const std::lock_guard lock(columns_.front().mutex);
    read(column, *columns_.front().reader, part, elevations);
}

void ColumnReaders::read(Column& column, RasterReader& reader, const Window& part,
                         std::span<double> elevations) {
    const std::int32_t col = std::max(part.col, column.begin);
    const Window here{part.row, col, part.rows, std::min(part.end_col(), column.end) - col};
    if (here.cols == part.cols)
        return reader.bands.read(here, elevations, warnings_);
    column.values.resize(static_cast<std::size_t>(here.points()));
    reader.bands.read(here, column.values, warnings_);
    for (std::int32_t row = 0; row < here.rows; ++row)
        std::copy_n(column.values.begin() + std::ptrdiff_t{row} * here.cols, here.cols,
                    elevations.begin() + (std::ptrdiff_t{row} * part.cols + (col - part.col)));
}

ReaderPool::ReaderPool(ReaderPtr first, RasterPlace place, Warnings& warnings)
    : place_(std::move(place)),
      warnings_(warnings),
      // Only GeoTIFF, because other drivers lock a library, unpack a file, or contact a server again.
      may_reopen_(place_.info.driver == "GTiff") {
    idle_.push_back(std::move(first));
}

ReaderPtr ReaderPool::take_idle(std::int32_t block_row) {
    const auto found =
        std::ranges::find_if(idle_, [&](const ReaderPtr& reader) { return reader->block_row == block_row; });
    if (found == idle_.end())
        return nullptr;
    ReaderPtr reader = std::move(*found);
    idle_.erase(found);
    return reader;
}

/// Exclusive right to decode a row of blocks, with its reader once there is one. The destructor releases both
/// and wakes waiting threads, also after an exception.
class ReaderPool::BlockRowLock {
  public:
    BlockRowLock(ReaderPool& pool, std::int32_t block_row) : pool_(pool), block_row_(block_row) {
        std::unique_lock lock(pool_.mutex_);
        pool_.returned_.wait(lock, [&] {
            return std::ranges::find(pool_.busy_rows_, block_row) == pool_.busy_rows_.end() &&
                   (pool_.may_reopen_ || !pool_.idle_.empty());
        });
        pool_.busy_rows_.push_back(block_row);
    }
    BlockRowLock(const BlockRowLock&) = delete;
    BlockRowLock& operator=(const BlockRowLock&) = delete;
    ~BlockRowLock() {
        {
            const std::lock_guard lock(pool_.mutex_);
            std::erase(pool_.busy_rows_, block_row_);
            if (reader)
                pool_.idle_.push_back(std::move(reader));
        }
        pool_.returned_.notify_all();
    }

    ReaderPtr reader;

  private:
    ReaderPool& pool_;
    std::int32_t block_row_;
};

ReaderPtr ReaderPool::take(std::int32_t block_row) {
    std::unique_lock lock(mutex_);
    ReaderPtr reader = take_idle(block_row);
    if (!reader && idle_.empty() && may_reopen_) {
        idle_.reserve(++readers_);
        lock.unlock();
        reader = place_.open();
        lock.lock();
        may_reopen_ = may_reopen_ && reader != nullptr;
    }
    returned_.wait(lock, [&] { return reader || !idle_.empty(); });
    if (!reader) {
        reader = std::move(idle_.back());
        idle_.pop_back();
    }
    // Frees decoded blocks, because GDAL would keep them although they are used again only by neighbouring
    // bands.
    if (std::abs(block_row - reader->block_row) > 1)
        reader->bands.drop_cached_blocks();
    reader->block_row = block_row;
    return reader;
}

void ReaderPool::read(const Window& part, std::span<double> elevations) {
    const std::int32_t block_row = (part.end_row() - 1) / place_.info.block_rows;
    BlockRowLock row_lock(*this, block_row);
    row_lock.reader = take(block_row);
    row_lock.reader->bands.read(part, elevations, warnings_);
}

}  // namespace

std::unique_ptr<ConcurrentRaster> make_concurrent(OpenRaster raster, const ReadOptions& options,
                                                  std::string path, const DemInfo& info, Warnings& warnings) {
    const std::vector<std::int32_t> ends = ends_of_columns(raster.dataset.get(), options.band);
    auto first = std::make_unique<RasterReader>(std::move(raster), options, info, warnings);
    RasterPlace place{options, std::move(path), info};
    if (ends.size() > 1)
        return std::make_unique<ColumnReaders>(std::move(first), std::move(place), warnings, ends);
    return std::make_unique<ReaderPool>(std::move(first), std::move(place), warnings);
}

}  // namespace d2b::reading
