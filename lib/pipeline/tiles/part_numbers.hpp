#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/spool.hpp"
#include "pipeline/tiles/tile_numbers.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "tiles/numbered_tile.hpp"

namespace d2b {

/// Stands in for the destination if tiles write their features into files of their own. Records which layers
/// each tile contributes to and the ids that it needs to write them.
class PartNumbers final : public FeatureSink, public PendingResult {
  public:
    explicit PartNumbers(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void finish() override {}

    /// Sets the tile of the following features.
    void set_tile(std::int64_t tile) { tile_ = tile; }
    /// Keeps a deferred contour that the merge step has drawn and numbered. @throws OutputError the spool is
    /// full
    void keep_contour(const DrawnContour& drawn);
    /// Writes the files of ids, one per tile. @param numbers ids of the contours that each tile has drawn
    /// @throws OutputError
    void write(const TileRun& run, const TileNumbers& numbers, int levels);

    [[nodiscard]] Kind kind() const override { return Kind::dataset; }
    /// Writes the file shared by all tiles, whose presence tells them that numbering is complete.
    void show() override;
    [[nodiscard]] std::string take_back() override;

  private:
    std::unique_ptr<Spool> spool_;
    std::map<std::int64_t, std::vector<SpoolEntry>> kept_;  ///< by tile, in the order of keys
    NumberedWhole whole_;
    std::filesystem::path frame_;  ///< path of the shared file
    Seal seal_;
    std::int64_t tile_ = 0;
};

}  // namespace d2b
