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

/// What all steps of a run in tiles share, and no step changes.
struct TileWork {
    std::filesystem::path folder;
    std::uint64_t plan = 0;  ///< digest of the plan
    std::int32_t side = 1;   ///< units of a tile in a row, and rows
    UnitSize units = {};
    /// What plan has found; nothing where each step finds it again.
    std::optional<UndeclaredValues> undeclared = {};
};

/// What a step begins with: the run is set up as one on the whole is.
class TileRun {
  public:
    /// @param features asked what a run asks a destination before the work
    /// @throws OptionError, InputError, OutputError as a run does
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
    /// Values of the window that stand for no data without being declared.
    [[nodiscard]] const UndeclaredValues& undeclared() const { return *work_.undeclared; }
    [[nodiscard]] SiftRules sift_rules() const;
    [[nodiscard]] FoundFacts no_facts() const;

    [[nodiscard]] Seal seal(TileStep step, std::int64_t tile) const {
        return {step, work_.plan, static_cast<std::uint32_t>(tile)};
    }
    /// What a step writes.
    [[nodiscard]] std::filesystem::path folder(TileStep step) const { return work_.folder / step_name(step); }
    [[nodiscard]] std::filesystem::path file(TileStep step, std::int64_t tile) const;
    /// Removes what processes have left that were killed while they worked on this step, all of whose files
    /// are there.
    void tidy(TileStep step) const { remove_unfinished(folder(step)); }
    /// What join or merge says of the whole.
    [[nodiscard]] std::filesystem::path frame_file(TileStep step = TileStep::join) const {
        return folder(step) / "frame";
    }
    [[nodiscard]] Seal frame_seal(TileStep step = TileStep::join) const;
    /// @throws InputError
    [[nodiscard]] FoundTile load_found(std::int64_t tile) const;
    [[nodiscard]] FoundFacts load_frame() const;
    /// What reading all sources has shown since the last call.
    [[nodiscard]] std::vector<std::string> take_warnings() const;

  private:
    TileWork work_;
    Sources sources_;
    Context context_;
    RunSetup setup_;
    UnitGrid units_;
    TileGrid tiles_;
};

/// Lets a step be set up that has no destination: what plan asked of the destination is known.
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

/// @throws OptionError where the steps cannot do exactly what is asked for: the option, and what to do
void require_tiles(const Options& options);

}  // namespace d2b
