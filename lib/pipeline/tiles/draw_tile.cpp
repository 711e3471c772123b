#include <algorithm>
#include <optional>
#include <utility>

#include "elevations/part_source.hpp"
#include "features/drawn_stack.hpp"
#include "features/target_frame.hpp"
#include "filter/contour_shelf.hpp"
#include "pipeline/feature_input.hpp"
#include "pipeline/measure_stack.hpp"
#include "pipeline/plan_tiers.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/tiles/draw_margin.hpp"
#include "pipeline/tiles/tile_labels.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "pipeline/tiles/trace_tile.hpp"
#include "pipeline/trace_contours.hpp"
#include "tiles/drawn_tile.hpp"

namespace d2b {
namespace {

/// Contours of a tile, divided into those that can be drawn now and those left to the merge step, because
/// their outlines depend on other tiles.
struct Divided {
    std::unique_ptr<StoredContours> whole;
    std::unique_ptr<StoredContours> left;
};

class TileDrawing {
  public:
    TileDrawing(TileRun& run, const JoinedTile& joined);

    /// Draws the tile. @param blocks receives the drawn contours
    [[nodiscard]] DrawnTile draw(DrawnBlocks& blocks);

  private:
    [[nodiscard]] FoundBuildings found() const;
    [[nodiscard]] LevelPlan global_levels() const;
    [[nodiscard]] Divided divide(const StoredContours& contours);
    void draw_whole(const StoredContours& contours, const FoundBuildings& found, DrawnTile& drawn,
                    DrawnBlocks& blocks);
    void leave(const StoredContours& contours, DrawnTile& drawn);
    void read_cells(DrawnTile& drawn);

    TileRun& run_;
    Context& context_;
    const JoinedTile& joined_;
    FoundFacts frame_;
    FixedPoint fixed_;
    TileLabels labels_;
    PartSource part_;
    ElevationReader reader_;
    LatticePoint reach_;
    Tiers tiers_;
    std::vector<bool> left_buildings_;  ///< by label - 1
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
      left_buildings_(joined.buildings.size()) {}

FoundBuildings TileDrawing::found() const {
    FoundBuildings found;
    found.labels = labels_.own(context_);
    found.buildings = joined_.sure();
    for (const JoinedBuilding& building : joined_.buildings)
        found.add(building.ground / run_.metres(),
                  {.confidence = building.confidence, .doubt = building.doubt, .parcel = building.parcel});
    return found;
}

/// Uses a scratch context because dropped levels are counted once for all tiles.
LevelPlan TileDrawing::global_levels() const {
    Context uncounted;
    return plan_global_levels(frame_.survey.statistics, run_.setup().plan.asked.levels,
                              run_.setup().plan.levels, uncounted);
}

Divided TileDrawing::divide(const StoredContours& contours) {
    const std::vector<bool> near = labels_.near_others(reach_);
    std::vector<bool> is_left(contours.size());
    for (const std::vector<std::uint32_t>& group : reach_of(contours, run_.setup(), context_).groups) {
        const bool left =
            std::ranges::any_of(group, [&](std::uint32_t i) { return near[contours.head(i).label - 1]; });
        for (const std::uint32_t i : group) {
            is_left[i] = left;
            if (left)
                left_buildings_[contours.head(i).label - 1] = true;
        }
    }
    ContourShelf whole(context_.make_spool());
    ContourShelf left(context_.make_spool());
    std::vector<std::int64_t> place(contours.size());
    for (std::size_t i = 0; i < contours.size(); ++i) {
        ContourShelf& shelf = is_left[i] ? left : whole;
        ContourHead head = contours.head(i);
        if (head.parent >= 0)
            head.parent = place[static_cast<std::size_t>(head.parent)];
        place[i] = static_cast<std::int64_t>(shelf.size());
        shelf.add(head, contours.fetch_stored(i));
    }
    return {whole.finish(), left.finish()};
}

void TileDrawing::draw_whole(const StoredContours& contours, const FoundBuildings& found, DrawnTile& drawn,
                             DrawnBlocks& blocks) {
    constexpr std::size_t piece = 64;  // contours per task
    const RunSetup& setup = run_.setup();
    const RecordMaker records(contours, {tiers_.plan, fixed_, found.footprints, run_.metres(),
                                         lattice_frame(run_.window(), setup.plan.trace)});
    const Outliner outliner = draw_outlines(contours, setup, context_);
    const FeatureInput input =
        feature_input(setup, {contours, outliner, found.buildings, fixed_}, context_.report, {});
    ContourDrawer drawer(input, records, context_);
    DrawnStack stack(context_.make_spool(), joined_.window);
    context_.threads->in_order((contours.size() + piece - 1) / piece,
                               [&](std::size_t k, std::size_t thread) {
                                   std::vector<DrawnContour> all;
                                   for (std::size_t i = k * piece;
                                        i < std::min(contours.size(), (k + 1) * piece); ++i)
                                       all.push_back(drawer.draw(i, thread));
                                   return all;
                               },
                               [&](std::size_t, const std::vector<DrawnContour>& all) {
                                   for (const DrawnContour& one : all) {
                                       if (drawer.gives_cells())
                                           add_to_stack(one, setup.layers.places, stack);
                                       blocks.add(one);
                                   }
                               });
    blocks.finish();
    for (PolygonMaker& maker : drawer.makers())
        context_.report.merge(maker.tally());
    if (drawer.gives_cells())
        drawn.error = measure_stack(stack, fixed_, reader_);
}

void TileDrawing::leave(const StoredContours& contours, DrawnTile& drawn) {
    std::vector<Label> number(joined_.buildings.size());
    for (std::size_t i = 0; i < left_buildings_.size(); ++i)
        if (left_buildings_[i]) {
            drawn.left_buildings.push_back({joined_.buildings[i], tiers_.plan.thresholds[i + 1]});
            number[i] = static_cast<Label>(drawn.left_buildings.size());
        }
    for (std::size_t i = 0; i < contours.size(); ++i) {
        drawn.left.push_back({contours.head(i), contours.fetch_stored(i)});
        ContourHead& head = drawn.left.back().head;
        head.label = number[head.label - 1];
    }
    drawn.cells.runs = labels_.around(left_buildings_, reach_);
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
    const RunSetup& setup = run_.setup();
    // The survey is run only for its side effect of filtering invalid elevations.
    (void)reader_.survey(
        run_.sift_rules(), [&](const ElevationBand&) { context_.check_stop(); }, Window{});
    const FoundBuildings buildings = found();
    tiers_ = plan_tiers(reader_, buildings, joined_.window, setup, fixed_, global_levels(), context_);
    const TraceFrame frame{joined_.window, tiers_.plan.level_count(), fixed_,
                           frame_.survey.statistics.range()};
    const auto contours =
        trace_contours(reader_, frame, {tiers_.plan, &buildings, tiers_.clean ? &*tiers_.clean : nullptr},
                       setup.plan, setup.area, run_.metres(), context_);
    DrawnTile drawn;
    drawn.levels = tiers_.plan.level_count();
    drawn.buildings = static_cast<std::int64_t>(buildings_up_to(buildings.buildings, *contours));
    const Divided divided = divide(*contours);
    draw_whole(*divided.whole, buildings, drawn, blocks);
    if (divided.left->size() > 0)
        leave(*divided.left, drawn);
    drawn.tally.merge(context_.report);
    return drawn;
}

}  // namespace

void draw_tile(TileRun& run, std::int64_t tile) {
    if (!run.setup().plan.detects_buildings())
        return trace_tile(run, tile);
    const auto path = run.file(TileStep::draw, tile);
    const Seal seal = run.seal(TileStep::draw, tile);
    if (is_sealed(path, seal))
        return;
    SealedFile file(run.file(TileStep::join, tile), run.seal(TileStep::join, tile));
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
    write_sealed(path, seal, writer.bytes(), blocks.bytes());
}

}  // namespace d2b
