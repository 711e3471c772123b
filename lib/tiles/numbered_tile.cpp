#include "tiles/numbered_tile.hpp"

#include <algorithm>
#include <functional>

namespace d2b {

void save(const NumberedTile& tile, ByteWriter& writer) {
    writer.put_list(tile.numbers.written);
    writer.put_list(tile.numbers.buildings);
    writer.put_list(tile.left);
}

NumberedTile load_numbered_tile(ByteReader& reader) {
    NumberedTile tile;
    tile.numbers.written = reader.take_list<std::int64_t>();
    tile.numbers.buildings = reader.take_list<std::int64_t>();
    tile.left = reader.take_list<DrawnBlock>();
    return tile;
}

void NumberedLayer::add(std::int64_t tile, const std::vector<WorldPolygon>& parts) {
    for (const WorldPolygon& part : parts)
        for (const Position& at : part.exterior) {
            const bool first = features == 0 && &part == parts.data() && &at == part.exterior.data();
            least = first ? at : Position{std::min(least.x, at.x), std::min(least.y, at.y)};
            most = first ? at : Position{std::max(most.x, at.x), std::max(most.y, at.y)};
        }
    ++features;
    const auto place = std::ranges::lower_bound(tiles, tile);
    if (place == tiles.end() || *place != tile)
        tiles.insert(place, tile);
}

void save(const NumberedWhole& whole, ByteWriter& writer) {
    writer.put(whole.levels);
    writer.put(static_cast<std::uint64_t>(whole.layers.size()));
    for (const NumberedLayer& layer : whole.layers) {
        writer.put(layer.features);
        writer.put(layer.least);
        writer.put(layer.most);
        writer.put_list(layer.tiles);
    }
}

NumberedWhole load_numbered_whole(ByteReader& reader, std::int64_t tiles) {
    NumberedWhole whole;
    whole.levels = reader.take<std::int32_t>();
    if (whole.levels < 1)
        throw BrokenRecord("there is no level");
    whole.layers.resize(reader.take_count(sizeof(std::int64_t)));
    for (NumberedLayer& layer : whole.layers) {
        layer.features = reader.take<std::int64_t>();
        layer.least = reader.take<Position>();
        layer.most = reader.take<Position>();
        layer.tiles = reader.take_list<std::int64_t>();
        if (std::ranges::adjacent_find(layer.tiles, std::greater_equal<>()) != layer.tiles.end() ||
            (!layer.tiles.empty() && (layer.tiles.front() < 0 || layer.tiles.back() >= tiles)))
            throw BrokenRecord("a layer has parts of tiles that are none of the plan's");
    }
    return whole;
}

}  // namespace d2b
