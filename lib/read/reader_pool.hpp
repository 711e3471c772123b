#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "read/shared_raster.hpp"

namespace d2b {

/// A raster that several threads read at a time: GDAL's datasets serve one each, so it is opened again for
/// those who would have to wait, where that is cheap and safe; else they wait. Those who want rows of the
/// same blocks get the same reader, one after the other, so that no block is decoded twice.
class ReaderPool final : public SharedRaster {
  public:
    /// @param path to open it again @param warnings outlives the pool
    ReaderPool(OpenRaster raster, const ReadOptions& options, std::string path, const DemInfo& info,
               Warnings& warnings);

    void read(const Window& part, std::span<double> elevations) override;

  private:
    struct Reader : RasterReader {
        using RasterReader::RasterReader;
        std::int32_t block_row = -1;  ///< of blocks, that it has decoded last and holds in its cache
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
    std::vector<ReaderPtr> idle_;        ///< has room for all
    std::vector<std::int32_t> at_work_;  ///< rows of blocks that readers who are not idle decode
};

}  // namespace d2b
