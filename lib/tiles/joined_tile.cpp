#include "tiles/joined_tile.hpp"

#include <algorithm>

namespace d2b {

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
        throw BrokenRecord("its window is not within that of the plan");
    tile.units.resize(reader.take_count(sizeof(std::int64_t)));
    for (JoinedUnit& unit : tile.units) {
        unit.unit = reader.take<std::int64_t>();
        unit.number = reader.take_list<Label>();
        if (unit.unit < 0 || unit.unit >= units || unit.number.empty() ||
            std::ranges::max(unit.number) > tile.other())
            throw BrokenRecord("a unit is none of the plan's");
    }
    return tile;
}

}  // namespace d2b
