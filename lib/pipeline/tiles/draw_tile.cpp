#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "contours/for_each_building.hpp"
#include "core/lattice.hpp"
#include "detect/surface_sampling.hpp"
#include "detect/units.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/divided_buildings.hpp"
#include "features/drawn_stack.hpp"
#include "features/reprojection.hpp"
#include "pipeline/extract_roofs.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/found_tile.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/trace_contours.hpp"

namespace d2b::tiles {

/// Labels of the buildings that a tile draws, and of other buildings near them, whichever tile found them.
class TileLabels {
  public:
    /// Reads the detection results of all tiles with units in the window. @throws InputError
    TileLabels(const TileRun& run, const JoinedTile& joined);

    /// Returns the labels of the tile's own buildings.
    [[nodiscard]] detect::LabelRows own(Context& context) const;
    /// Marks, by label - 1, buildings with another tile's building within reach. @param reach rows and
    /// columns
    [[nodiscard]] std::vector<bool> near_other_tiles(LatticePoint reach) const;
    /// Returns the cells within reach of the wanted buildings, row by row. @param wanted by label - 1
    [[nodiscard]] std::vector<RowSpan> cells_near(const std::vector<bool>& wanted, LatticePoint reach) const;

  private:
    /// Returns the runs of a row of the window, from left to right.
    [[nodiscard]] std::span<const LabelRun> row(std::int32_t row) const;

    Window window_;
    Label buildings_;
    std::vector<LabelRun> runs_;      ///< in scan order; label buildings_ + 1 marks other tiles' buildings
    std::vector<std::size_t> first_;  ///< first run of each row of the window; one more at the end
};

namespace {

constexpr std::int32_t rows_per_read = 256;

/// Contours of a tile, divided into those that can be drawn now and those left to the merge step, because
/// their outlines depend on other tiles.
struct DividedContours {
    std::unique_ptr<contours::StoredContours> whole;
    std::unique_ptr<contours::StoredContours> left;
};

class TileDrawing {
  public:
    TileDrawing(TileRun& run, const JoinedTile& joined);

    /// Draws the tile. @param blocks receives the drawn contours
    [[nodiscard]] DrawnTile draw(DrawnBlocks& blocks);

  private:
    [[nodiscard]] pipeline::FoundBuildings found() const;
    [[nodiscard]] contours::LevelPlan global_levels() const;
    [[nodiscard]] DividedContours divide(const contours::StoredContours& contours);
    void draw_whole(const contours::StoredContours& contours, const pipeline::FoundBuildings& found,
                    DrawnTile& drawn, DrawnBlocks& blocks);
    [[nodiscard]] features::StoredRoofs extract_roofs(const contours::StoredContours& contours,
                                                      const outline::Outliner& outliner,
                                                      const pipeline::FoundBuildings& found);
    void defer(const contours::StoredContours& contours, DrawnTile& drawn);
    void read_cells(DrawnTile& drawn);

    TileRun& run_;
    Context& context_;
    const JoinedTile& joined_;
    FoundFacts frame_;
    FixedPoint fixed_;
    TileLabels labels_;
    SubwindowSource part_;
    ElevationReader reader_;
    LatticePoint reach_;
    pipeline::Tiers tiers_;
    std::vector<bool> deferred_buildings_;                 ///< by label - 1
    std::map<Label, contours::BuildingCells> roof_cells_;  ///< of deferred buildings, with roofs
};

TileDrawing::TileDrawing(TileRun& run, const JoinedTile& joined)
    : run_(run),
      context_(run.context()),
      joined_(joined),
      frame_(run.load_frame()),
      fixed_(frame_.survey.statistics.fixed_point()),
      labels_(run, joined),
      part_(run.sources().dem, joined.window),
      reader_(part_, context_),
      reach_(draw_reach(run.setup(), context_)),
      deferred_buildings_(joined.buildings.size()) {
    context_.report.sampling = detect::sampling_report(frame_.scene.sampling, run.metres());
}

pipeline::FoundBuildings TileDrawing::found() const {
    pipeline::FoundBuildings found;
    found.labels = labels_.own(context_);
    found.buildings = joined_.sure();
    for (const JoinedBuilding& building : joined_.buildings)
        found.add(building.footprint(run_.metres()));
    return found;
}

/// Uses a scratch context because dropped levels are counted once for all tiles.
contours::LevelPlan TileDrawing::global_levels() const {
    Context uncounted;
    return contours::plan_global_levels(frame_.survey.statistics, run_.setup().plan.asked.levels,
                                        run_.setup().plan.levels, uncounted);
}

DividedContours TileDrawing::divide(const contours::StoredContours& contours) {
    const std::vector<bool> near = labels_.near_other_tiles(reach_);
    std::vector<bool> is_deferred(contours.size());
    for (const std::vector<std::uint32_t>& group :
         features::outline_dependencies_of(contours, run_.setup(), context_).groups) {
        const bool left =
            std::ranges::any_of(group, [&](std::uint32_t i) { return near[contours.head(i).label - 1]; });
        for (const std::uint32_t i : group) {
            is_deferred[i] = left;
            if (left)
                deferred_buildings_[contours.head(i).label - 1] = true;
        }
    }
    contours::ContourMerger whole(context_.make_spool());
    contours::ContourMerger left(context_.make_spool());
    std::vector<std::int64_t> place(contours.size());
    for (std::size_t i = 0; i < contours.size(); ++i) {
        contours::ContourMerger& merger = is_deferred[i] ? left : whole;
        contours::ContourHead head = contours.head(i);
        if (head.parent >= 0)
            head.parent = place[static_cast<std::size_t>(head.parent)];
        place[i] = static_cast<std::int64_t>(merger.size());
        merger.add(head, contours.fetch_stored(i));
    }
    return {whole.finish(), left.finish()};
}

/// Extracts the roofs of contours that are drawn now, and keeps the cells from which merge will extract
/// others.
features::StoredRoofs TileDrawing::extract_roofs(const contours::StoredContours& contours,
                                                 const outline::Outliner& outliner,
                                                 const pipeline::FoundBuildings& found) {
    pipeline::RoofExtractor roofs(contours, outliner, found.buildings, run_.setup(), context_);
    std::mutex mutex;
    contours::for_each_building(reader_, found.labels, found.count(), joined_.window, Stage::roofs, context_,
                                [&](Label label, contours::BuildingCells&& cells) {
                                    roofs.extract(label, cells);
                                    if (label > found.buildings || !deferred_buildings_[label - 1])
                                        return;
                                    const std::lock_guard lock(mutex);
                                    roof_cells_[label] = std::move(cells);
                                });
    return roofs.take();
}

void TileDrawing::draw_whole(const contours::StoredContours& contours, const pipeline::FoundBuildings& found,
                             DrawnTile& drawn, DrawnBlocks& blocks) {
    const features::RunSetup& setup = run_.setup();
    const features::RecordBuilder records(contours,
                                          {tiers_.plan, fixed_, found.footprints, run_.metres(),
                                           features::lattice_frame(run_.window(), setup.plan.trace)});
    const outline::Outliner outliner = features::draw_outlines(contours, setup, context_);
    std::optional<features::StoredRoofs> roofs;
    if (setup.plan.needs_roofs())
        roofs.emplace(extract_roofs(contours, outliner, found));
    const features::FeatureInput input{setup,  contours, outliner, found.buildings,
                                       fixed_, nullptr,  nullptr,  roofs ? &*roofs : nullptr};
    features::ContourDrawer drawer(input, records, context_);
    features::DrawnStack stack(context_.make_spool(), joined_.window);
    drawer.draw_all([&](std::size_t, const features::DrawnContour& contour) {
        if (drawer.returns_cells())
            features::add_to_stack(contour, setup.layers.indices, stack);
        blocks.add(contour);
    });
    blocks.finish();
    for (features::PolygonMaker& maker : drawer.makers())
        context_.report.merge(maker.tally());
    if (drawer.returns_cells())
        drawn.error = pipeline::measure_stack(stack, fixed_, reader_);
}

void TileDrawing::defer(const contours::StoredContours& contours, DrawnTile& drawn) {
    std::vector<Label> number(joined_.buildings.size());
    for (std::size_t i = 0; i < deferred_buildings_.size(); ++i)
        if (deferred_buildings_[i]) {
            drawn.deferred_buildings.push_back({joined_.buildings[i], tiers_.plan.thresholds[i + 1],
                                                std::move(roof_cells_[static_cast<Label>(i + 1)])});
            number[i] = static_cast<Label>(drawn.deferred_buildings.size());
        }
    for (std::size_t i = 0; i < contours.size(); ++i) {
        drawn.left.push_back({contours.head(i), contours.fetch_stored(i)});
        contours::ContourHead& head = drawn.left.back().head;
        head.label = number[head.label - 1];
    }
    drawn.cells.runs = labels_.cells_near(deferred_buildings_, reach_);
    read_cells(drawn);
}

void TileDrawing::read_cells(DrawnTile& drawn) {
    auto run = drawn.cells.runs.begin();
    reader_.for_each([&](const ElevationBand& band) {
        for (; run != drawn.cells.runs.end() && run->row < band.shape.first_row + band.shape.rows; ++run) {
            const auto row = band.row(run->row - band.shape.first_row);
            drawn.cells.elevations.insert(drawn.cells.elevations.end(),
                                          row.begin() + (run->begin - joined_.window.col),
                                          row.begin() + (run->end - joined_.window.col));
        }
    });
}

DrawnTile TileDrawing::draw(DrawnBlocks& blocks) {
    const features::RunSetup& setup = run_.setup();
    run_.filter_elevations(reader_);
    const pipeline::FoundBuildings buildings = found();
    tiers_ =
        pipeline::plan_tiers(reader_, buildings, joined_.window, setup, fixed_, global_levels(), context_);
    const contours::TraceFrame frame{joined_.window, tiers_.plan.level_count(), fixed_,
                                     frame_.survey.statistics.range()};
    const auto contours = pipeline::trace_contours(reader_, frame, tiers_, &buildings, setup, context_);
    DrawnTile drawn;
    drawn.levels = tiers_.plan.level_count();
    drawn.buildings = static_cast<std::int64_t>(pipeline::buildings_up_to(buildings.buildings, *contours));
    drawn.parts = features::parts_of_wholes(*contours, buildings.footprints);
    const DividedContours divided = divide(*contours);
    draw_whole(*divided.whole, buildings, drawn, blocks);
    if (divided.left->size() > 0)
        defer(*divided.left, drawn);
    drawn.tally.merge(context_.report);
    return drawn;
}

}  // namespace

TileLabels::TileLabels(const TileRun& run, const JoinedTile& joined)
    : window_(joined.window), buildings_(static_cast<Label>(joined.buildings.size())) {
    std::map<std::int64_t, std::vector<const JoinedUnit*>> tiles;  // reads each tile once
    for (const JoinedUnit& unit : joined.units)
        tiles[run.tiles().tile_of(unit.unit)].push_back(&unit);
    for (const auto& [tile, units] : tiles) {
        const FoundTile found = run.load_found(tile);
        const std::vector<NumberedUnit> placed = run.tiles().units_of(tile);
        for (const JoinedUnit* unit : units) {
            const auto here = std::ranges::find(placed, unit->unit, &NumberedUnit::number);
            for (LabelRun label : found.units[static_cast<std::size_t>(here - placed.begin())].runs) {
                label.begin = std::max(label.begin, window_.col);
                label.end = std::min(label.end, window_.end_col());
                if (label.label >= unit->number.size())
                    throw InputError(
                        "What 'join' wrote of tile " + std::to_string(tile) +
                        " does not fit what 'find' wrote; delete the folders of both steps and run "
                        "them again.");
                label.label = unit->number[label.label];
                if (label.label != 0 && label.begin < label.end && label.row >= window_.row &&
                    label.row < window_.end_row())
                    runs_.push_back(label);
            }
        }
    }
    std::ranges::sort(runs_, {}, [](const LabelRun& r) { return std::pair(r.row, r.begin); });
    first_.resize(static_cast<std::size_t>(window_.rows) + 1);
    for (const LabelRun& label : runs_)
        ++first_[static_cast<std::size_t>(label.row - window_.row) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
}

std::span<const LabelRun> TileLabels::row(std::int32_t row) const {
    if (row < window_.row || row >= window_.end_row())
        return {};
    const auto i = static_cast<std::size_t>(row - window_.row);
    return std::span(runs_).subspan(first_[i], first_[i + 1] - first_[i]);
}

detect::LabelRows TileLabels::own(Context& context) const {
    detect::LabelRows rows(context.make_spool(), window_);
    for (std::int32_t first = window_.row; first < window_.end_row(); first += rows_per_read) {
        const Window part{first, window_.col, std::min(rows_per_read, window_.end_row() - first),
                          window_.cols};
        Grid<Label> labels(part.rows, part.cols);
        for (std::int32_t r = part.row; r < part.end_row(); ++r)
            for (const LabelRun& run : row(r))
                if (run.label <= buildings_)
                    std::fill(labels.row(r - part.row).begin() + (run.begin - part.col),
                              labels.row(r - part.row).begin() + (run.end - part.col), run.label);
        rows.append({part, part}, labels, *context.threads);
    }
    std::vector<Label> number(buildings_ + std::size_t{1});
    for (Label label = 0; label <= buildings_; ++label)
        number[label] = label;
    rows.renumber(std::move(number));
    return rows;
}

std::vector<bool> TileLabels::near_other_tiles(LatticePoint reach) const {
    std::vector<bool> near(buildings_);
    for (const LabelRun& other : runs_) {
        if (other.label <= buildings_)
            continue;
        for (std::int32_t r = other.row - reach.row; r <= other.row + reach.row; ++r) {
            const auto runs = row(r);
            // Runs of a row do not overlap, so their ends ascend as well.
            auto run = std::ranges::lower_bound(runs, other.begin - reach.col, {}, &LabelRun::end);
            for (; run != runs.end() && run->begin <= other.end + reach.col; ++run)
                if (run->label <= buildings_)
                    near[run->label - 1] = true;
        }
    }
    return near;
}

std::vector<RowSpan> TileLabels::cells_near(const std::vector<bool>& wanted, LatticePoint reach) const {
    std::vector<RowSpan> expanded;
    for (const LabelRun& run : runs_) {
        if (run.label > buildings_ || !wanted[run.label - 1])
            continue;
        for (std::int32_t r = std::max(run.row - reach.row, window_.row);
             r <= std::min(run.row + reach.row, window_.end_row() - 1); ++r)
            expanded.push_back({r, std::max(run.begin - reach.col, window_.col),
                                std::min(run.end + reach.col, window_.end_col())});
    }
    std::ranges::sort(expanded, {}, [](const RowSpan& s) { return std::pair(s.row, s.begin); });
    std::vector<RowSpan> spans;
    for (const RowSpan& span : expanded) {
        if (!spans.empty() && spans.back().row == span.row && span.begin <= spans.back().end)
            spans.back().end = std::max(spans.back().end, span.end);
        else
            spans.push_back(span);
    }
    return spans;
}

void draw_tile(TileRun& run, std::int64_t tile) {
    const Checkpoint place = run.file(TileStep::draw, tile);
    if (checkpoint_exists(place))
        return;
    CheckpointFile file(run.file(TileStep::join, tile));
    const JoinedTile joined = load_body(file, [&](ByteReader& reader) {
        return load_joined_tile(reader, run.window(), run.tiles().units().count());
    });
    DrawnBlocks blocks;
    DrawnTile drawn;
    if (!joined.buildings.empty())
        drawn = TileDrawing(run, joined).draw(blocks);
    ByteWriter writer;
    save(drawn, writer);
    writer.put_list(blocks.blocks());
    write_checkpoint(place, writer.bytes(), blocks.bytes());
}

}  // namespace d2b::tiles
