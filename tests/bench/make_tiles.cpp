// make_tiles <work> <contours a tile> find|draw: writes the files of a plan's step for each of its
// tiles, as if each were a unit with so many contours of small houses. The readers of these files do not look
// behind them: this measures join and merge on countries that nobody has the disk for.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "core/band.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings_tiles/plan_file.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/found_tile.hpp"
#include "read/gdal_setup.hpp"

namespace d2b {
namespace {

using namespace tiles;
using detect::CounterEvidence;
using features::DrawnContour;
using features::FeaturePolygon;
using reading::start_gdal;

constexpr std::int32_t levels = 4;  ///< of a house
constexpr std::int32_t side = 10;   ///< cells of a house, in a row and in a column
constexpr std::int32_t step = 40;   ///< from a house to the next one

/// The cells of a house of a tile.
Window house(const Window& own, std::int32_t number) {
    const std::int32_t across = (own.cols - step) / step;
    return {own.row + step / 2 + number / across * step, own.col + step / 2 + number % across * step, side,
            side};
}

void make_found(const TileRun& run, std::int64_t tile, std::int32_t houses, CheckpointBatch& files) {
    FoundTile found{run.empty_facts(), {}};
    const NumberedUnit placed = run.tiles().units_of(tile).at(0);
    const Window own = placed.unit.own;
    found.facts.survey.statistics.add(std::vector<double>{1, 30});
    found.facts.scene.sides = {true, true, true};  // nothing lies beside it that there could be too little of
    FoundUnit& unit = found.units.emplace_back();
    for (std::int32_t i = 0; i < houses; ++i) {
        const Window cells = house(own, i);
        unit.objects.push_back({{0.9, CounterEvidence::rough, cells.points(), -1}, true, 1, cells.points()});
        for (std::int32_t row = cells.row; row < cells.end_row(); ++row)
            unit.runs.push_back({row, cells.col, cells.end_col(), static_cast<Label>(i + 1)});
    }
    std::ranges::sort(unit.runs, {}, [](const LabelRun& one) { return std::pair(one.row, one.begin); });
    const std::vector<Label> wide(static_cast<std::size_t>(own.cols));
    const std::vector<Label> high(static_cast<std::size_t>(own.rows));
    const Window& all = run.window();
    if (own.row > all.row)
        unit.edges.above = {wide, wide};
    if (own.end_row() < all.end_row())
        unit.edges.below = {wide, wide};
    if (own.col > all.col)
        unit.edges.left = {high, high};
    if (own.end_col() < all.end_col())
        unit.edges.right = {high, high};
    ByteWriter writer;
    save(found, writer);
    files.write(run.file(TileStep::find, tile), writer.bytes());
}

FeaturePolygon polygon_of(const Window& cells) {
    const auto corner = [&](std::int32_t row, std::int32_t col) {
        return Position{static_cast<double>(col), -static_cast<double>(row)};
    };
    FeaturePolygon made;
    WorldPolygon& part = made.parts.emplace_back();
    part.exterior = {corner(cells.row, cells.col), corner(cells.end_row(), cells.col),
                     corner(cells.end_row(), cells.end_col()), corner(cells.row, cells.end_col()),
                     corner(cells.row, cells.col)};
    made.measure = {static_cast<double>(cells.points()), 4.0 * side};
    return made;
}

void make_drawn(const TileRun& run, std::int64_t tile, std::int32_t houses, CheckpointBatch& files) {
    const Window own = run.tiles().whole(tile).own;
    DrawnTile drawn;
    drawn.levels = levels + 1;
    drawn.buildings = houses;
    DrawnBlocks blocks;
    for (std::int32_t level = 1; level <= levels; ++level)
        for (std::int32_t i = 0; i < houses; ++i) {
            const Window cells = house(own, i);
            DrawnContour contour;
            contour.key = {level, {cells.row, cells.col}};
            contour.parent = level == 1 ? -1 : std::int64_t{level - 2} * houses + i;
            contour.building_index = i;
            contour.record.level = level;
            if (level == 1)
                contour.building = polygon_of(cells);
            contour.contour = polygon_of(cells);
            blocks.add(contour);
        }
    blocks.finish();
    ByteWriter writer;
    save(drawn, writer);
    writer.put_list(blocks.blocks());
    files.write(run.file(TileStep::draw, tile), writer.bytes(), blocks.bytes());
}

void make(const std::string& work, std::int32_t contours, const std::string& what) {
    start_gdal();
    const KnownPlan known = read_plan(std::filesystem::absolute(work));
    std::filesystem::current_path(known.plan.folder);
    const Options options = parse_command_line(known.plan.words).options;
    const Inputs inputs = open_inputs(options, {});
    PlannedSink nowhere(known.plan.layers);
    const TileRun run(known.work, options, inputs.sources(), nowhere, {});
    const bool find = what == "find";
    CheckpointBatch files(run.folder(find ? TileStep::find : TileStep::draw));
    for (std::int64_t tile = 0; tile < run.tiles().count(); ++tile)
        (find ? make_found : make_drawn)(run, tile, contours / levels, files);
    files.finish();
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    if (argc != 4) {
        std::cerr << "usage: make_tiles <work> <contours a tile> find|draw\n";
        return 2;
    }
    try {
        d2b::make(argv[1], std::atoi(argv[2]), argv[3]);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
