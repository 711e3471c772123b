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

/// Takes the place of the destination where tiles write features into files of their own: notes which tiles
/// have features in which layer, and what each tile must know to write them.
class PartNumbers final : public FeatureSink, public PendingResult {
  public:
    explicit PartNumbers(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void finish() override {}

    /// The tile that the next features are of.
    void set_tile(std::int64_t tile) { tile_ = tile; }
    /// A contour of that tile that merge has drawn and numbered. @throws OutputError the spool has no room
    void keep_contour(const DrawnContour& drawn);
    /// Writes what each tile must know. @param numbers of what each tile has drawn @throws OutputError
    void write(const TileRun& run, const TileNumbers& numbers, int levels);

    [[nodiscard]] Kind kind() const override { return Kind::dataset; }
    /// Writes what all tiles must know, by which they see that the numbers are there.
    void show() override;
    [[nodiscard]] std::string take_back() override;

  private:
    std::unique_ptr<Spool> spool_;
    std::map<std::int64_t, std::vector<SpoolEntry>> kept_;  ///< by tile, in the order of keys
    NumberedWhole whole_;
    std::filesystem::path frame_;  ///< the file for all tiles
    Seal seal_;
    std::int64_t tile_ = 0;
};

}  // namespace d2b
