#include "read/reader_pool.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {

ReaderPool::ReaderPool(OpenRaster raster, const ReadOptions& options, std::string path, const DemInfo& info,
                       Warnings& warnings)
    : options_(options),
      path_(std::move(path)),
      info_(info),
      warnings_(warnings),
      // Only GeoTIFF, because other drivers lock a library, unpack a file, or contact a server again.
      may_reopen_(info.driver == "GTiff") {
    idle_.push_back(std::make_unique<Reader>(std::move(raster), options, info, warnings));
}

ReaderPool::ReaderPtr ReaderPool::reopen() const {
    try {
        Warnings unheard;  // repeats warnings of the first opening
        return std::make_unique<Reader>(open_raster(options_, path_, unheard), options_, info_, unheard);
    } catch (const Error&) {
        return nullptr;
    }
}

ReaderPool::ReaderPtr ReaderPool::idle_with(std::int32_t block_row) {
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
class ReaderPool::Turn {
  public:
    Turn(ReaderPool& pool, std::int32_t block_row) : pool_(pool), block_row_(block_row) {
        std::unique_lock lock(pool_.mutex_);
        pool_.returned_.wait(lock, [&] {
            return std::ranges::find(pool_.at_work_, block_row) == pool_.at_work_.end() &&
                   (pool_.may_reopen_ || !pool_.idle_.empty());
        });
        pool_.at_work_.push_back(block_row);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() {
        {
            const std::lock_guard lock(pool_.mutex_);
            std::erase(pool_.at_work_, block_row_);
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

ReaderPool::ReaderPtr ReaderPool::take(std::int32_t block_row) {
    std::unique_lock lock(mutex_);
    ReaderPtr reader = idle_with(block_row);
    if (!reader && idle_.empty() && may_reopen_) {
        idle_.reserve(++readers_);
        lock.unlock();
        reader = reopen();
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
        reader->bands.forget_blocks();
    reader->block_row = block_row;
    return reader;
}

void ReaderPool::read(const Window& part, std::span<double> elevations) {
    const std::int32_t block_row = (part.end_row() - 1) / info_.block_rows;
    Turn turn(*this, block_row);
    turn.reader = take(block_row);
    turn.reader->bands.read(part, elevations, warnings_);
}

}  // namespace d2b
