#include "pipeline/tiles/tile_run.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "features/contour_drawer.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b::tiles {
namespace {

/// Returns the first unit that ends beyond a row or column. Binary search, because ends ascend.
template <typename EndOf>
std::int32_t first_ending_after(std::int32_t place, std::int32_t count, const EndOf& end_of) {
    std::int32_t first = 0;
    while (first < count) {
        const std::int32_t middle = std::midpoint(first, count);
        if (end_of(middle) > place)
            count = middle;
        else
            first = middle + 1;
    }
    return first;
}

class EmptyContourList final : public contours::ContourList {
  public:
    [[nodiscard]] std::size_t size() const override { return 0; }
    [[nodiscard]] const contours::ContourHead& head(std::size_t /*contour*/) const override { return none_; }
    [[nodiscard]] contours::Contour fetch(std::size_t /*contour*/) const override { return {}; }

  private:
    contours::ContourHead none_;
};

}  // namespace

TileGrid::TileGrid(const detect::UnitGrid& units, std::int32_t side)
    : units_(units),
      side_(std::min(side, std::max(units.rows(), units.cols()))),
      rows_((units.rows() - 1) / side_ + 1),
      cols_((units.cols() - 1) / side_ + 1) {}

std::vector<NumberedUnit> TileGrid::units_of(std::int64_t tile) const {
    const auto first_row = static_cast<std::int32_t>(tile / cols_) * side_;
    const auto first_col = static_cast<std::int32_t>(tile % cols_) * side_;
    std::vector<NumberedUnit> all;
    for (std::int32_t row = first_row; row < std::min(first_row + side_, units_.rows()); ++row)
        for (std::int32_t col = first_col; col < std::min(first_col + side_, units_.cols()); ++col)
            all.push_back(unit(std::int64_t{row} * units_.cols() + col));
    return all;
}

std::int64_t TileGrid::tile_of(std::int64_t unit) const {
    return unit / units_.cols() / side_ * cols_ + unit % units_.cols() / side_;
}

NumberedUnit TileGrid::unit(std::int64_t number) const {
    return {number, units_.unit(static_cast<std::int32_t>(number / units_.cols()),
                                static_cast<std::int32_t>(number % units_.cols()))};
}

std::vector<NumberedUnit> TileGrid::units_in(const Window& window) const {
    const std::int32_t first_row = first_ending_after(
        window.row, units_.rows(), [&](std::int32_t i) { return units_.unit(i, 0).own.end_row(); });
    const std::int32_t first_col = first_ending_after(
        window.col, units_.cols(), [&](std::int32_t i) { return units_.unit(0, i).own.end_col(); });
    std::vector<NumberedUnit> all;
    for (std::int32_t row = first_row; row < units_.rows(); ++row) {
        for (std::int32_t col = first_col; col < units_.cols(); ++col) {
            all.push_back(unit(std::int64_t{row} * units_.cols() + col));
            if (all.back().unit.own.end_col() >= window.end_col())
                break;
        }
        if (all.back().unit.own.end_row() >= window.end_row())
            break;
    }
    return all;
}

detect::Unit TileGrid::whole(std::int64_t tile) const {
    detect::Unit all;
    for (const NumberedUnit& placed : units_of(tile))
        all = {bounding_window(all.own, placed.unit.own), bounding_window(all.seen, placed.unit.seen)};
    return all;
}

Window bounding_window(const Window& a, const Window& b) {
    if (a.points() == 0 || b.points() == 0)
        return a.points() == 0 ? b : a;
    const std::int32_t row = std::min(a.row, b.row);
    const std::int32_t col = std::min(a.col, b.col);
    return {row, col, std::max(a.end_row(), b.end_row()) - row, std::max(a.end_col(), b.end_col()) - col};
}

Window expanded(const Window& window, std::int32_t rows, std::int32_t cols, const Window& within) {
    const std::int32_t row = window.row - std::min(rows, window.row - within.row);
    const std::int32_t col = window.col - std::min(cols, window.col - within.col);
    return {row, col, window.end_row() + std::min(rows, within.end_row() - window.end_row()) - row,
            window.end_col() + std::min(cols, within.end_col() - window.end_col()) - col};
}

TileRun::TileRun(const TileRunParameters& work, const Options& options, const Sources& sources,
                 FeatureSink& features, const Callbacks& callbacks)
    : work_(work),
      dem_(sources.dem),
      sources_(with_dem(sources, dem_)),
      context_(callbacks),
      setup_(pipeline::set_up_run(options, sources.dem.info(), features, context_, sources.footprints)),
      units_(pipeline::unit_grid(setup_.plan, setup_.dem.window, setup_.cell, work.units)),
      tiles_(units_, work.side) {
    if (!work_.undeclared)
        work_.undeclared =
            undeclared_values(sources.dem, setup_.plan.asked,
                              d2b::validity_rules(setup_.plan.asked.read, false, setup_.dem, metres()),
                              setup_.cell_m(), nullptr, context_);
    dem_.set_margin(work_.undeclared->margin);
}

ValidityRules TileRun::validity_rules() const {
    ValidityRules rules = d2b::validity_rules(setup_.plan.asked.read, true, setup_.dem, metres());
    rules.undeclared = undeclared().values();
    return rules;
}

/// The survey is run only for its side effect.
void TileRun::filter_elevations(ElevationReader& reader) const {
    (void)reader.survey(
        validity_rules(), [this](const ElevationBand&) { context_.check_stop(); }, Window{});
}

FoundFacts TileRun::empty_facts() const {
    return FoundFacts(validity_rules(), setup_.plan.asked.detect.min_height);
}

Checkpoint TileRun::file(TileStep step, std::int64_t tile) const {
    return {folder(step) / std::to_string(tile), step, work_.plan, static_cast<std::uint32_t>(tile)};
}

Checkpoint TileRun::frame_file(TileStep step) const {
    return {folder(step) / "frame", step, work_.plan, std::numeric_limits<std::uint32_t>::max()};
}

FoundTile TileRun::load_found(std::int64_t tile) const {
    std::vector<Window> windows;
    for (const NumberedUnit& placed : tiles_.units_of(tile))
        windows.push_back(placed.unit.own);
    CheckpointFile file(this->file(TileStep::find, tile));
    return load_body(file,
                     [&](ByteReader& reader) { return load_found_tile(reader, empty_facts(), windows); });
}

FoundFacts TileRun::load_frame() const {
    CheckpointFile file(frame_file());
    return load_body(file, [&](ByteReader& reader) {
        FoundFacts facts = empty_facts();
        facts.load(reader);
        return facts;
    });
}

void require_tileable(const Options& options) {
    const auto refuse = [](bool asked, const std::string& option, const std::string& what) {
        if (asked)
            throw OptionError(option + " does not work in tiles: " + what +
                              "; leave it out, or run dem2buildings.");
    };
    if (!detects_buildings(options))
        throw OptionError(
            "-preset thesis does not work in tiles, because a contour may fill the whole raster; run "
            "dem2buildings -preset thesis.");
    const WriteOptions& write = options.write;
    refuse(!write.preview.empty(), "-preview", "a picture needs the whole area");
    refuse(!write.surfaces.empty(), "-surface", "a surface needs the whole area");
    refuse(!write.page.empty(), "-page", "a page needs the whole area");
    const std::string flow = "changes of outlines depend on others that may be far away";
    refuse(options.outline.flow_ready > 0, "-flow_ready", flow);
    refuse(options.outline.min_gap.has_value(), "-min_gap", flow);
    refuse(options.outline.min_wall.has_value(), "-min_wall", flow);
    refuse(options.outline.simplify > 0, "-simplify", "simplified borders may be shared by all tiles");
    refuse(write.rejected, "-write_rejected", "only a run without tiles keeps dropped contours");
}

LatticePoint draw_reach(const features::RunSetup& setup, Context& context) {
    // One more cell, because contours run along cell borders or through cell centres depending on the trace
    // mode.
    const LatticePoint cells = features::outline_dependencies_of(EmptyContourList(), setup, context).cells;
    return {cells.row + 1, cells.col + 1};
}

LatticePoint draw_margin(const features::RunSetup& setup, Context& context) {
    const LatticePoint reach = draw_reach(setup, context);
    return {reach.row + 1, reach.col + 1};
}

}  // namespace d2b::tiles
