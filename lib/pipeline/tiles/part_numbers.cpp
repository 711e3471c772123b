#include "pipeline/tiles/part_numbers.hpp"

#include <system_error>
#include <utility>

#include "tiles/drawn_contour.hpp"

namespace d2b {

void PartNumbers::begin(std::span<const LayerSpec> layers, const Provenance& /*provenance*/) {
    whole_.layers.resize(layers.size());
}

void PartNumbers::add(std::size_t layer, const Feature& feature) {
    whole_.layers[layer].add(tile_, feature.parts);
}

void PartNumbers::keep_contour(const DrawnContour& drawn) {
    ByteWriter writer;
    save(drawn, writer);
    kept_[tile_].push_back(append(*spool_, writer));
}

void PartNumbers::write(const TileRun& run, const TileNumbers& numbers, int levels) {
    SealedFiles files(run.folder(TileStep::merge));
    for (std::int64_t i = 0; i < run.tiles().count(); ++i) {
        NumberedTile tile{numbers.all(static_cast<std::size_t>(i)), {}};
        DrawnBlocks blocks;
        if (const auto kept = kept_.find(i); kept != kept_.end())
            for (const SpoolEntry& entry : kept->second) {
                ByteReader reader(*spool_, entry);
                blocks.add(load_drawn_contour(reader));
            }
        blocks.finish();
        tile.left = blocks.blocks();
        ByteWriter writer;
        save(tile, writer);
        files.write(run.file(TileStep::merge, i), run.seal(TileStep::merge, i), writer.bytes(),
                    blocks.bytes());
    }
    files.finish();
    whole_.levels = levels;
    frame_ = run.frame_file(TileStep::merge);
    seal_ = run.frame_seal(TileStep::merge);
}

void PartNumbers::show() {
    ByteWriter writer;
    save(whole_, writer);
    write_sealed(frame_, seal_, writer.bytes());
}

std::string PartNumbers::take_back() {
    std::error_code error;
    std::filesystem::remove(frame_, error);
    return error ? "\"" + frame_.string() + "\" is there already" : "";
}

}  // namespace d2b
