#include "pipeline/tiles/found_tile.hpp"

#include <algorithm>
#include <utility>

#include "core/grid.hpp"

namespace d2b::tiles {
namespace {

/// Run-length encodes the labels of a seam, because most of them are 0.
void save_labels(const std::vector<Label>& line, ByteWriter& writer) {
    writer.put_varint(line.size());
    for (auto begin = line.begin(); begin != line.end();) {
        const auto end = std::find_if(begin, line.end(), [&](Label label) { return label != *begin; });
        writer.put_varint(static_cast<std::uint64_t>(end - begin));
        writer.put_varint(*begin);
        begin = end;
    }
}

/// @param labels largest valid label
std::vector<Label> load_labels(ByteReader& reader, Label labels, std::int32_t cells) {
    const std::int32_t length = reader.take_varint(cells);
    if (length > 0 && length < cells)
        throw CorruptRecord("a seam does not belong to its unit");
    std::vector<Label> line;
    while (static_cast<std::int32_t>(line.size()) < length) {
        const std::int32_t run = reader.take_varint(length - static_cast<std::int32_t>(line.size()));
        const std::uint64_t label = reader.take_varint();
        if (run == 0 || label > labels)
            throw CorruptRecord("a seam does not belong to its unit");
        line.insert(line.end(), static_cast<std::size_t>(run), static_cast<Label>(label));
    }
    return line;
}

void save(const detect::UnitEdges::Lines& lines, ByteWriter& writer) {
    for (const std::vector<Label>& line : lines)
        save_labels(line, writer);
}

void save(const FoundUnit& unit, ByteWriter& writer) {
    writer.put_list(unit.objects);
    writer.put_list(unit.runs);
    for (const detect::UnitEdges::Lines* lines :
         {&unit.edges.above, &unit.edges.left, &unit.edges.below, &unit.edges.right})
        save(*lines, writer);
    writer.put_list(unit.footprints);
}

detect::UnitEdges::Lines load_lines(ByteReader& reader, Label labels, std::int32_t cells) {
    detect::UnitEdges::Lines lines;
    for (std::vector<Label>& line : lines)
        line = load_labels(reader, labels, cells);
    return lines;
}

FoundUnit load_found_unit(ByteReader& reader, const Window& own) {
    FoundUnit unit;
    unit.objects = reader.take_list<detect::SeenObject>();
    unit.runs = reader.take_list<LabelRun>();
    const auto labels = static_cast<Label>(unit.objects.size());
    for (const LabelRun& run : unit.runs)
        if (run.label == 0 || run.label > labels || run.begin >= run.end || !own.holds(run.row, run.begin) ||
            run.end > own.end_col())
            throw CorruptRecord("labels lie outside of their unit");
    unit.edges.above = load_lines(reader, labels, own.cols);
    unit.edges.left = load_lines(reader, labels, own.rows);
    unit.edges.below = load_lines(reader, labels, own.cols);
    unit.edges.right = load_lines(reader, labels, own.rows);
    unit.footprints = reader.take_list<SeenGiven>();
    return unit;
}

}  // namespace

std::vector<LabelRun> label_runs(const detect::Unit& unit, const Grid<Label>& labels) {
    const Window& own = unit.own;
    std::vector<LabelRun> runs;
    for (std::int32_t row = own.row; row < own.end_row(); ++row)
        for_equal_runs(labels.row(row - unit.seen.row)
                           .subspan(static_cast<std::size_t>(own.col - unit.seen.col),
                                    static_cast<std::size_t>(own.cols)),
                       [&](std::int32_t begin, std::int32_t end, Label label) {
                           runs.push_back({row, own.col + begin, own.col + end, label});
                       });
    return runs;
}

void FoundFacts::merge(const FoundFacts& other) {
    survey.statistics.merge(other.survey.statistics);
    survey.suspicious.merge(other.survey.suspicious);
    scene.merge(other.scene);
    terrain_outside += other.terrain_outside;
    tally.merge(other.tally);
    for (const std::string& text : other.warnings)
        if (std::ranges::find(warnings, text) == warnings.end())
            warnings.push_back(text);
    effective.insert(other.effective.begin(), other.effective.end());
}

void FoundFacts::save(ByteWriter& writer) const {
    writer.put(survey.statistics);
    survey.suspicious.save(writer);
    writer.put(scene);
    writer.put(terrain_outside);
    writer.put(tally);
    writer.put(static_cast<std::uint64_t>(warnings.size()));
    for (const std::string& text : warnings)
        writer.put_text(text);
    writer.put_list(std::vector<std::uint64_t>(effective.begin(), effective.end()));
}

void FoundFacts::load(ByteReader& reader) {
    survey.statistics = reader.take<ElevationStatistics>();
    survey.suspicious.load(reader);
    scene = reader.take<detect::SceneStatistics>();
    terrain_outside = reader.take<std::int64_t>();
    tally = reader.take<Tally>();
    warnings.resize(reader.take_count(sizeof(std::uint64_t)));
    for (std::string& text : warnings)
        text = reader.take_text();
    const auto corrections = reader.take_list<std::uint64_t>();
    effective = {corrections.begin(), corrections.end()};
}

void save(const FoundTile& tile, ByteWriter& writer) {
    tile.facts.save(writer);
    for (const FoundUnit& unit : tile.units)
        save(unit, writer);
}

FoundTile load_found_tile(ByteReader& reader, FoundFacts facts, const std::vector<Window>& windows) {
    facts.load(reader);
    FoundTile tile{std::move(facts), {}};
    for (const Window& own : windows)
        tile.units.push_back(load_found_unit(reader, own));
    return tile;
}

Label JoinedTile::sure() const {
    return static_cast<Label>(std::ranges::count_if(buildings, &JoinedBuilding::is_building));
}

void save(const JoinedTile& tile, ByteWriter& writer) {
    writer.put_list(tile.buildings);
    writer.put(tile.window);
    writer.put(static_cast<std::uint64_t>(tile.units.size()));
    for (const JoinedUnit& unit : tile.units) {
        writer.put(unit.unit);
        writer.put_list(unit.number);
    }
}

JoinedTile load_joined_tile(ByteReader& reader, const Window& window, std::int64_t units) {
    JoinedTile tile;
    tile.buildings = reader.take_list<JoinedBuilding>();
    tile.window = reader.take<Window>();
    const Window& part = tile.window;
    const bool is_empty = tile.buildings.empty() && part == Window{};
    if (!is_empty && (part.rows < 0 || part.cols < 0 || part.row < window.row || part.col < window.col ||
                      part.rows > window.end_row() - part.row || part.cols > window.end_col() - part.col))
        throw CorruptRecord("its window is not within that of the plan");
    tile.units.resize(reader.take_count(sizeof(std::int64_t)));
    for (JoinedUnit& unit : tile.units) {
        unit.unit = reader.take<std::int64_t>();
        unit.number = reader.take_list<Label>();
        if (unit.unit < 0 || unit.unit >= units || unit.number.empty() ||
            std::ranges::max(unit.number) > tile.other())
            throw CorruptRecord("a unit is not part of the plan");
    }
    return tile;
}

}  // namespace d2b::tiles
