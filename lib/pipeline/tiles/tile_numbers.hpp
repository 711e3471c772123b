#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/spool.hpp"
#include "features/feature_writer.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b::tiles {

/// Ids of the contours that each tile has drawn. Contours of all tiles arrive level by level and row by row,
/// so those of one tile are consecutive once per level. In between its ids are spooled, because memory
/// must not grow with the number of contours.
class TileIds {
  public:
    TileIds(std::unique_ptr<Spool> spool, std::size_t tiles);

    /// Returns the ids that a tile's contours of the current level need: contours of the level below, those
    /// of this level so far, and buildings. Valid until spool_level() of the tile. @throws OutputError the
    /// spool cannot be read
    [[nodiscard]] features::AssignedIds& of(std::size_t tile);
    /// Spools a tile's ids after its last contour of a level. @throws OutputError the spool is full
    void spool_level(std::size_t tile);
    /// Returns all ids of a tile. Call after all have been spooled. @throws OutputError
    [[nodiscard]] features::AssignedIds all(std::size_t tile) const;

  private:
    struct SpooledIds {
        SpoolEntry buildings;
        std::vector<SpoolEntry> written;  ///< one entry per level
        std::int64_t before = 0;          ///< number of contours below the last of these levels
        std::int64_t contours = 0;        ///< total number of contours
    };
    template <typename T>
    [[nodiscard]] SpoolEntry append(const std::vector<T>& numbers, std::size_t from);
    template <typename T>
    void read(const SpoolEntry& entry, std::vector<T>& numbers) const;

    std::unique_ptr<Spool> spool_;
    std::vector<SpooledIds> spooled_;
    std::unordered_map<std::size_t, features::AssignedIds> in_memory_;
};

/// Stands in for the destination if tiles write their features into files of their own. Records which layers
/// each tile contributes to and the ids that it needs to write them.
class IdCollectorSink final : public FeatureSink, public PendingResult {
  public:
    explicit IdCollectorSink(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void finish() override {}

    /// Sets the tile of the following features.
    void set_tile(std::int64_t tile) { tile_ = tile; }
    /// Keeps a deferred contour that the merge step has drawn and numbered. @throws OutputError the spool is
    /// full
    void add_deferred(const features::DrawnContour& drawn);
    /// Writes the files of ids, one per tile. @param numbers ids of the contours that each tile has drawn
    /// @throws OutputError
    void write(const TileRun& run, const TileIds& numbers, int levels);

    [[nodiscard]] Kind kind() const override { return Kind::dataset; }
    /// Writes the file shared by all tiles, whose presence tells them that numbering is complete.
    void show() override;
    [[nodiscard]] std::string roll_back() override;

  private:
    std::unique_ptr<Spool> spool_;
    std::map<std::int64_t, std::vector<SpoolEntry>> kept_;  ///< by tile, in the order of keys
    NumberedWhole whole_;
    Checkpoint frame_;  ///< the shared file
    std::int64_t tile_ = 0;
};

}  // namespace d2b::tiles
