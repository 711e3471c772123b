#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/context.hpp"
#include "core/lattice.hpp"
#include "core/undeclared_nodata.hpp"
#include "dem2buildings/run.hpp"
#include "detect/units.hpp"
#include "elevations/filter_invalid.hpp"
#include "elevations/unblended_source.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/checkpoint_file.hpp"
#include "pipeline/tiles/found_tile.hpp"

namespace d2b::tiles {

/// Unit with its row-major index.
struct NumberedUnit {
    std::int64_t number = 0;  ///< row-major
    detect::Unit unit;
};

/// Groups units into tiles, the portions of work of one process. The result does not depend on the tiles.
/// Tiles are numbered row by row.
class TileGrid {
  public:
    /// @param units must outlive this @param side rows and columns of units in a tile
    TileGrid(const detect::UnitGrid& units, std::int32_t side);

    [[nodiscard]] std::int64_t count() const { return std::int64_t{rows_} * cols_; }
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    [[nodiscard]] const detect::UnitGrid& units() const { return units_; }
    /// Returns the units of a tile, row by row.
    [[nodiscard]] std::vector<NumberedUnit> units_of(std::int64_t tile) const;
    /// Returns the tile that contains a unit.
    [[nodiscard]] std::int64_t tile_of(std::int64_t unit) const;
    [[nodiscard]] NumberedUnit unit(std::int64_t number) const;
    /// Returns the units with own cells in a window, row by row.
    [[nodiscard]] std::vector<NumberedUnit> units_in(const Window& window) const;
    /// Returns the union of all units of a tile.
    [[nodiscard]] detect::Unit whole(std::int64_t tile) const;

  private:
    const detect::UnitGrid& units_;
    std::int32_t side_;
    std::int32_t rows_;
    std::int32_t cols_;
};

/// Returns the bounding window of both; if one is empty, the other one.
[[nodiscard]] Window bounding_window(const Window& a, const Window& b);
/// Expands a window by rows and columns on each side, clipped to `within`.
[[nodiscard]] Window expanded(const Window& window, std::int32_t rows, std::int32_t cols,
                              const Window& within);

/// Parameters shared by all steps of a tiled run; constant over the run.
struct TileRunParameters {
    std::filesystem::path folder;
    std::uint64_t plan = 0;  ///< digest of the plan
    std::int32_t side = 1;   ///< rows and columns of units in a tile
    detect::UnitSize units = {};
    /// Result of the plan step; nullopt if each step searches again.
    std::optional<UndeclaredNodata> undeclared = {};
};

/// Environment of a step. It is set up the same way as an untiled run.
class TileRun {
  public:
    /// @param features is asked the same as in an untiled run before the work
    /// @throws OptionError, InputError, OutputError as in an untiled run
    TileRun(const TileRunParameters& work, const Options& options, const Sources& sources,
            FeatureSink& features, const Callbacks& callbacks);
    TileRun(const TileRun&) = delete;
    TileRun& operator=(const TileRun&) = delete;
    ~TileRun() = default;

    [[nodiscard]] const TileRunParameters& work() const { return work_; }
    [[nodiscard]] const Sources& sources() const { return sources_; }
    [[nodiscard]] const features::RunSetup& setup() const { return setup_; }
    [[nodiscard]] const TileGrid& tiles() const { return tiles_; }
    [[nodiscard]] Context& context() { return context_; }
    [[nodiscard]] const Window& window() const { return setup_.dem.window; }
    [[nodiscard]] double metres() const { return context_.report.units.vertical_metres; }
    /// Values in the window that denote missing data without being declared as nodata.
    [[nodiscard]] const UndeclaredNodata& undeclared() const { return *work_.undeclared; }
    [[nodiscard]] ValidityRules validity_rules() const;
    /// Makes a reader of the elevations filter invalid ones. @throws InputError, Cancelled
    void filter_elevations(ElevationReader& reader) const;
    [[nodiscard]] bool has_footprints() const { return setup_.plan.asked.write.has_footprints(); }
    [[nodiscard]] FoundFacts empty_facts() const;

    /// Returns the folder that a step writes to.
    [[nodiscard]] std::filesystem::path folder(TileStep step) const { return work_.folder / step_name(step); }
    /// Returns the file that a step writes of a tile.
    [[nodiscard]] Checkpoint file(TileStep step, std::int64_t tile) const;
    /// Removes files left by killed processes. Call only if all files of the step exist.
    void remove_leftovers(TileStep step) const { remove_unfinished(folder(step)); }
    /// Returns the file in which join or merge stores its results for the whole window.
    [[nodiscard]] Checkpoint frame_file(TileStep step = TileStep::join) const;
    /// @throws InputError
    [[nodiscard]] FoundTile load_found(std::int64_t tile) const;
    [[nodiscard]] FoundFacts load_frame() const;

  private:
    TileRunParameters work_;
    UnblendedSource dem_;
    Sources sources_;
    Context context_;
    features::RunSetup setup_;
    detect::UnitGrid units_;
    TileGrid tiles_;
};

/// Placeholder sink for steps without a destination, because the plan step has already asked the real one.
class PlannedSink final : public FeatureSink {
  public:
    explicit PlannedSink(Layers layers) : layers_(layers) {}
    void begin(std::span<const LayerSpec> /*layers*/, const Provenance& /*provenance*/) override {}
    void add(std::size_t /*layer*/, const Feature& /*feature*/) override {}
    void finish() override {}
    [[nodiscard]] Layers layers(std::optional<Layers> /*asked*/) const override { return layers_; }

  private:
    Layers layers_;
};

/// @throws OptionError naming an option that does not work in tiles, and a remedy
void require_tileable(const Options& options);

/// Returns the rows and columns around a building's cells within which its outline lies or another building
/// affects it.
[[nodiscard]] LatticePoint draw_reach(const features::RunSetup& setup, Context& context);
/// Returns draw_reach() plus the border that is needed to filter elevations.
[[nodiscard]] LatticePoint draw_margin(const features::RunSetup& setup, Context& context);

}  // namespace d2b::tiles
