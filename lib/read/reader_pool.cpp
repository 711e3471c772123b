#include "read/reader_pool.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace d2b {

ReaderPool::ReaderPool(OpenRaster raster, const ReadOptions& options, std::string path, const DemInfo& info,
                       Context& context)
    : options_(options),
      path_(std::move(path)),
      info_(info),
      context_(context),
      // Other drivers lock a library, unpack a file, or ask a server once more.
      may_reopen_(info.driver == "GTiff") {
    idle_.push_back(std::make_unique<Reader>(std::move(raster), options, info, context));
}

ReaderPool::ReaderPtr ReaderPool::reopen() const {
    try {
        Context own;  // all has been said when it was opened first
        return std::make_unique<Reader>(open_raster(options_, path_, own), options_, info_, own);
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

ReaderPool::ReaderPtr ReaderPool::take(std::int32_t block_row) {
    std::unique_lock lock(mutex_);
    returned_.wait(lock, [&] {
        return std::ranges::find(at_work_, block_row) == at_work_.end() && (may_reopen_ || !idle_.empty());
    });
    ReaderPtr reader = idle_with(block_row);
    at_work_.push_back(block_row);
    if (!reader && idle_.empty()) {
        lock.unlock();
        reader = reopen();
        lock.lock();
        may_reopen_ = may_reopen_ && reader != nullptr;
        returned_.wait(lock, [&] { return reader || !idle_.empty(); });
    }
    if (!reader) {
        reader = std::move(idle_.back());
        idle_.pop_back();
    }
    reader->block_row = block_row;
    return reader;
}

void ReaderPool::give_back(ReaderPtr reader, const std::vector<std::string>& warnings) {
    {
        const std::lock_guard lock(mutex_);
        std::erase(at_work_, reader->block_row);
        idle_.push_back(std::move(reader));
        const std::vector<std::string>& said = context_.report.warnings;
        for (const std::string& text : warnings)
            if (std::ranges::find(said, text) == said.end())
                context_.warn(text);
    }
    returned_.notify_all();
}

void ReaderPool::read(std::int32_t first_row, std::int32_t rows, std::span<double> elevations) {
    ReaderPtr reader = take((first_row + rows - 1) / info_.block_rows);
    Context own;
    {
        const std::lock_guard lock(mutex_);
        own.report.warnings = context_.report.warnings;  // which say how many more there may be
    }
    try {
        reader->bands.read(first_row, rows, elevations, own);
    } catch (...) {
        give_back(std::move(reader), own.report.warnings);
        throw;
    }
    give_back(std::move(reader), own.report.warnings);
}

}  // namespace d2b
