#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/context.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/run.hpp"
#include "elevations/sift.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/tile_grid.hpp"
#include "tiles/found_tile.hpp"
#include "tiles/sealed_file.hpp"

namespace d2b {

/// Parameters shared by all steps of a tiled run; constant over the run.
struct TileWork {
    std::filesystem::path folder;
    std::uint64_t plan = 0;  ///< digest of the plan
    std::int32_t side = 1;   ///< rows and columns of units in a tile
    UnitSize units = {};
    /// Result of the plan step; nullopt if each step searches again.
    std::optional<UndeclaredValues> undeclared = {};
};

/// Environment of a step. It is set up the same way as an untiled run.
class TileRun {
  public:
    /// @param features is asked the same as in an untiled run before the work
    /// @throws OptionError, InputError, OutputError as in an untiled run
    TileRun(const TileWork& work, const Options& options, const Sources& sources, FeatureSink& features,
            const Callbacks& callbacks);
    TileRun(const TileRun&) = delete;
    TileRun& operator=(const TileRun&) = delete;
    ~TileRun() = default;

    [[nodiscard]] const TileWork& work() const { return work_; }
    [[nodiscard]] const Sources& sources() const { return sources_; }
    [[nodiscard]] const RunSetup& setup() const { return setup_; }
    [[nodiscard]] const TileGrid& tiles() const { return tiles_; }
    [[nodiscard]] Context& context() { return context_; }
    [[nodiscard]] const Window& window() const { return setup_.dem.window; }
    [[nodiscard]] double metres() const { return context_.report.units.vertical_metres; }
    /// Values in the window that denote missing data without being declared as nodata.
    [[nodiscard]] const UndeclaredValues& undeclared() const { return *work_.undeclared; }
    [[nodiscard]] SiftRules sift_rules() const;
    [[nodiscard]] FoundFacts no_facts() const;

    [[nodiscard]] Seal seal(TileStep step, std::int64_t tile) const {
        return {step, work_.plan, static_cast<std::uint32_t>(tile)};
    }
    /// Returns the folder that a step writes to.
    [[nodiscard]] std::filesystem::path folder(TileStep step) const { return work_.folder / step_name(step); }
    [[nodiscard]] std::filesystem::path file(TileStep step, std::int64_t tile) const;
    /// Removes files left by killed processes. Call only if all files of the step exist.
    void tidy(TileStep step) const { remove_unfinished(folder(step)); }
    /// Returns the file in which join or merge stores its results for the whole window.
    [[nodiscard]] std::filesystem::path frame_file(TileStep step = TileStep::join) const {
        return folder(step) / "frame";
    }
    [[nodiscard]] Seal frame_seal(TileStep step = TileStep::join) const;
    /// @throws InputError
    [[nodiscard]] FoundTile load_found(std::int64_t tile) const;
    [[nodiscard]] FoundFacts load_frame() const;
    /// Returns the warnings of all sources since the last call.
    [[nodiscard]] std::vector<std::string> take_warnings() const;

  private:
    TileWork work_;
    Sources sources_;
    Context context_;
    RunSetup setup_;
    UnitGrid units_;
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
void require_tiles(const Options& options);

}  // namespace d2b
