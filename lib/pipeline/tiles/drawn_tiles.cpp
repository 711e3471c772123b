#include "pipeline/tiles/drawn_tiles.hpp"

#include <algorithm>
#include <utility>

#include "filter/contour_shelf.hpp"

namespace d2b {

DrawnTiles::DrawnTiles(const TileRun& run, Context& context) : elevations(context.make_spool()) {
    for (std::int64_t i = 0; i < run.tiles().count(); ++i) {
        context.check_stop();
        SealedFile file(run.file(TileStep::draw, i), run.seal(TileStep::draw, i), &files_);
        std::vector<DrawnBlock> blocks;
        DrawnTile tile = load_body(file, [&](ByteReader& reader) {
            DrawnTile loaded = load_drawn_tile(reader);
            blocks = reader.take_list<DrawnBlock>();
            return loaded;
        });
        streams.emplace_back(std::move(file), std::move(blocks));
        take(std::move(tile));
    }
    number_left(run.metres());
    ContourShelf shelf(context.make_spool());
    for (const LeftContour& contour : left_)
        shelf.add(contour.head, contour.stored);
    left = shelf.finish();
    left_ = std::vector<LeftContour>();  // = {} would keep the capacity
}

void DrawnTiles::take(DrawnTile&& tile) {
    tally.merge(tile.tally);
    levels = std::max(levels, static_cast<int>(tile.levels));
    buildings += tile.buildings;
    error.merge(tile.error);
    elevations.add(tile.cells);
    const auto labels = static_cast<Label>(left_buildings_.size());
    const auto before = static_cast<std::int64_t>(left_.size());
    left_buildings_.insert(left_buildings_.end(), tile.left_buildings.begin(), tile.left_buildings.end());
    left_by_.resize(left_buildings_.size(), static_cast<std::int64_t>(streams.size()) - 1);
    for (LeftContour& contour : tile.left) {
        contour.head.label += labels;
        if (contour.head.parent >= 0)
            contour.head.parent += before;
        left_.push_back(std::move(contour));
    }
}

/// Numbers buildings first, low-confidence candidates after them.
void DrawnTiles::number_left(double metres) {
    std::vector<Label> number(left_buildings_.size() + 1);
    plan.footprints = true;
    plan.thresholds = {{}};
    for (const bool is_sure : {true, false}) {
        for (std::size_t i = 0; i < left_buildings_.size(); ++i) {
            const JoinedBuilding& facts = left_buildings_[i].facts;
            if (facts.is_building != is_sure)
                continue;
            number[i + 1] = static_cast<Label>(footprints.size());
            footprints.push_back(
                {facts.ground / metres, facts.confidence, doubt_name(facts.doubt), facts.parcel});
            plan.thresholds.push_back(left_buildings_[i].thresholds);
            tiles.push_back(left_by_[i]);
        }
        if (is_sure)
            sure = static_cast<Label>(footprints.size() - 1);
    }
    for (LeftContour& contour : left_)
        contour.head.label = number[contour.head.label];
}

}  // namespace d2b
