#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "read/shared_raster.hpp"

namespace d2b {

/// Raster that several threads read concurrently. A GDAL dataset serves one thread at a time, so it is opened
/// again for threads that would have to wait, if that is cheap and safe; otherwise they wait. Threads that
/// need rows of the same blocks use the same reader in turn, so that no block is decoded twice.
class ReaderPool final : public SharedRaster {
  public:
    /// @param path for opening it again @param warnings outlives the pool
    ReaderPool(OpenRaster raster, const ReadOptions& options, std::string path, const DemInfo& info,
               Warnings& warnings);

    void read(const Window& part, std::span<double> elevations) override;

  private:
    struct Reader : RasterReader {
        using RasterReader::RasterReader;
        std::int32_t block_row = -1;  ///< row of blocks that it decoded last and holds in its cache
    };
    using ReaderPtr = std::unique_ptr<Reader>;

    class Turn;

    [[nodiscard]] ReaderPtr take(std::int32_t block_row);
    [[nodiscard]] ReaderPtr idle_with(std::int32_t block_row);
    [[nodiscard]] ReaderPtr reopen() const;

    ReadOptions options_;
    std::string path_;
    DemInfo info_;
    Warnings& warnings_;
    std::mutex mutex_;
    std::condition_variable returned_;
    bool may_reopen_;
    std::size_t readers_ = 1;
    std::vector<ReaderPtr> idle_;        ///< capacity for all readers
    std::vector<std::int32_t> at_work_;  ///< rows of blocks being decoded
};

}  // namespace d2b
