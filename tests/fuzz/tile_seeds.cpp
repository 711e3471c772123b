// Seeds of tiles_fuzz: small files that the steps of a run in tiles write.
//   tile_seeds <folder>           writes them
//   tile_seeds --check <folder>   fails where one is not read to its end: the format has changed since
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "fuzz/tile_files.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/found_tile.hpp"

namespace d2b::test {
namespace {

namespace fs = std::filesystem;

/// Content of a file behind the numbers that it begins with.
template <typename Value, typename Begin>
ByteWriter after(const Value& value, const Begin& begin) {
    ByteWriter first;
    begin(first);
    ByteWriter all;
    tiles::save(value, all);
    ByteWriter rest;
    rest.put_bytes(all.bytes().subspan(first.bytes().size()));
    return rest;
}

constexpr auto nothing = [](ByteWriter&) {};

/// Two objects, of which one lies on the seam on the right.
tiles::FoundTile found() {
    tiles::FoundTile tile{empty_facts(), {}};
    tiles::FoundUnit& unit = tile.units.emplace_back();
    const Window& w = tile_window;
    unit.objects = {{{0.9, detect::CounterEvidence::rough, 6, -1}, true, 1.5, 6},
                    {{0.4, detect::CounterEvidence::green, 4, -1}, false, 2, 4}};
    for (std::int32_t row = 1; row < 3; ++row)
        unit.runs.push_back({w.row + row, w.col + 1, w.col + 4, 1});
    for (std::int32_t row = 4; row < 6; ++row)
        unit.runs.push_back({w.row + row, w.end_col() - 2, w.end_col(), 2});
    std::vector<Label> line(static_cast<std::size_t>(w.rows));
    line[4] = line[5] = 2;
    unit.edges.right = {line, line};
    unit.footprints = {{7, {1, 6, 5, 1, 1.5, 0.5}}};
    return tile;
}

tiles::JoinedTile joined() {
    tiles::JoinedTile tile;
    tile.buildings = {{true, detect::CounterEvidence::rough, 1.5, 0.9, -1, 3},
                      {false, detect::CounterEvidence::green, 2, 0.4, -1}};
    tile.window = tile_window;
    tile.units = {{0, {0, 1, 2}}, {2, {0, 3}}};
    return tile;
}

/// A building that is left to merge, with a tier.
tiles::DrawnTile drawn() {
    tiles::DrawnTile tile;
    tile.levels = 2;
    tile.parts = {{3, 1}, {3, 2}};
    tile.deferred_buildings = {
        {{true, detect::CounterEvidence::rough, 1.5, 0.9, -1, 3}, {2.5, 4}, {{{1, 2, 4}}, {6, 7}}}};
    for (std::int32_t level = 1; level <= 2; ++level) {
        tiles::DeferredContour left;
        left.head.key = {level, {level, level}};
        left.head.label = 1;
        left.head.parent = level - 2;
        tile.left.push_back(left);
    }
    tile.cells = {{{1, 1, 4}, {2, 1, 3}}, {5, 6, 7, 8, 9}};
    return tile;
}

tiles::NumberedTile numbered() {
    return {{{1, 2, 2, 4}, {{1, 1, 1}, {2, 1, 4}}, 0}, {{{300, 17}, {1, {3, 4}}}}};
}

tiles::NumberedWhole numbered_whole() {
    tiles::NumberedWhole whole;
    whole.levels = 3;
    whole.layers.resize(2);
    for (tiles::NumberedLayer& layer : whole.layers) {
        WorldPolygon part;
        part.exterior = {{0, 0}, {3, 0}, {3, 2}, {0, 0}};
        layer.add(2, {part});
        layer.add(0, {part});
    }
    return whole;
}

features::DrawnContour contour() {
    features::DrawnContour drawn;
    drawn.key = {1, {3, 4}};
    drawn.parent = -1;
    drawn.building_index = 0;
    drawn.record.level = 1;
    features::FeaturePolygon made;
    WorldPolygon& part = made.parts.emplace_back();
    part.exterior = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}};
    part.interiors = {{{1, 1}, {1, 2}, {2, 2}, {1, 1}}};
    made.measure = {80.5, 39};
    drawn.building = made;
    drawn.contour = made;
    drawn.building_record.roof_shape.type = "shed";
    features::DrawnFace& face = drawn.faces.emplace_back();
    face.record.kind = "pitched";
    face.parts = made.parts;
    face.parts[0].elevations = {3, 3, 4, 4, 3, 3.1, 3.2, 3.2, 3.1};
    return drawn;
}

void write(const fs::path& folder, const std::string& name, TileFile kind, const ByteWriter& bytes) {
    std::ofstream file(folder / name, std::ios::binary);
    file.put(static_cast<char>(kind));
    for (const std::byte byte : bytes.bytes())
        file.put(static_cast<char>(byte));
    file.flush();
    if (!file)
        throw std::runtime_error("'" + (folder / name).string() + "' cannot be written");
}

void write_all(const fs::path& folder) {
    write(folder, "found", TileFile::found,
          after(found(), [](ByteWriter& writer) { empty_facts().save(writer); }));
    write(folder, "joined", TileFile::joined, after(joined(), nothing));
    write(folder, "drawn", TileFile::drawn, after(drawn(), [](ByteWriter& writer) {
              writer.put(Tally());
              writer.put(std::int32_t{1});
              writer.put(std::int64_t{0});
              writer.put(features::StackError());
          }));
    write(folder, "numbered", TileFile::numbered, after(numbered(), nothing));
    write(folder, "numbered_whole", TileFile::numbered_whole, after(numbered_whole(), nothing));
    write(folder, "contour", TileFile::contour, after(contour(), nothing));
}

/// @return whether all is well
bool check(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    try {
        if (read_tile_file(std::as_bytes(std::span(bytes))) == 0)
            return true;
        std::cerr << file << ": more is there than is read\n";
    } catch (const CorruptRecord& broken) {
        std::cerr << file << ": " << broken.what() << '\n';
    }
    return false;
}

}  // namespace
}  // namespace d2b::test

int main(int argc, char* argv[]) {
    namespace fs = std::filesystem;
    const bool checks = argc == 3 && argv[1] == std::string("--check");
    if (argc != 2 && !checks) {
        std::cerr << "usage: tile_seeds [--check] <folder>\n";
        return 2;
    }
    if (!checks) {
        d2b::test::write_all(argv[1]);
        return 0;
    }
    bool all = true;
    int files = 0;
    for (const auto& entry : fs::directory_iterator(argv[2])) {
        all = d2b::test::check(entry.path()) && all;
        ++files;
    }
    return all && files == d2b::test::tile_files ? 0 : 1;
}
