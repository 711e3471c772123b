#include "pipeline/tiles/tile_numbers.hpp"

#include <span>
#include <system_error>
#include <utility>

namespace d2b::tiles {

TileIds::TileIds(std::unique_ptr<Spool> spool, std::size_t tiles)
    : spool_(std::move(spool)), spooled_(tiles) {}

template <typename T>
SpoolEntry TileIds::append(const std::vector<T>& numbers, std::size_t from) {
    const auto bytes = std::as_bytes(std::span(numbers).subspan(from));
    return {spool_->append(bytes), bytes.size()};
}

template <typename T>
void TileIds::read(const SpoolEntry& entry, std::vector<T>& numbers) const {
    const std::size_t before = numbers.size();
    numbers.resize(before + static_cast<std::size_t>(entry.size) / sizeof(T));
    spool_->read(entry.begin, std::as_writable_bytes(std::span(numbers).subspan(before)));
}

features::AssignedIds& TileIds::of(std::size_t tile) {
    const auto [at, is_new] = in_memory_.try_emplace(tile);
    features::AssignedIds& numbers = at->second;
    const SpooledIds& spooled = spooled_[tile];
    if (is_new && !spooled.written.empty()) {
        numbers.before = spooled.before;
        read(spooled.written.back(), numbers.written);
        read(spooled.buildings, numbers.buildings);
    }
    return numbers;
}

void TileIds::spool_level(std::size_t tile) {
    const auto at = in_memory_.find(tile);
    if (at == in_memory_.end())
        return;
    const features::AssignedIds& numbers = at->second;
    SpooledIds& spooled = spooled_[tile];
    // Buildings are contours of the first level.
    if (spooled.written.empty())
        spooled.buildings = append(numbers.buildings, 0);
    spooled.written.push_back(
        append(numbers.written, static_cast<std::size_t>(spooled.contours - numbers.before)));
    spooled.before = spooled.contours;
    spooled.contours = numbers.before + std::ssize(numbers.written);
    in_memory_.erase(at);
}

features::AssignedIds TileIds::all(std::size_t tile) const {
    features::AssignedIds numbers;
    const SpooledIds& spooled = spooled_[tile];
    for (const SpoolEntry& entry : spooled.written)
        read(entry, numbers.written);
    read(spooled.buildings, numbers.buildings);
    return numbers;
}

void IdCollectorSink::begin(std::span<const LayerSpec> layers, const Provenance& /*provenance*/) {
    whole_.layers.resize(layers.size());
}

void IdCollectorSink::add(std::size_t layer, const Feature& feature) {
    whole_.layers[layer].add(tile_, feature.parts);
}

void IdCollectorSink::add_deferred(const features::DrawnContour& drawn) {
    ByteWriter writer;
    save(drawn, writer);
    kept_[tile_].push_back(append(*spool_, writer));
}

void IdCollectorSink::write(const TileRun& run, const TileIds& numbers, int levels) {
    CheckpointBatch files(run.folder(TileStep::merge));
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
        files.write(run.file(TileStep::merge, i), writer.bytes(), blocks.bytes());
    }
    files.finish();
    whole_.levels = levels;
    frame_ = run.frame_file(TileStep::merge);
}

void IdCollectorSink::show() {
    ByteWriter writer;
    save(whole_, writer);
    write_checkpoint(frame_, writer.bytes());
}

std::string IdCollectorSink::roll_back() {
    std::error_code error;
    std::filesystem::remove(frame_.path, error);
    return error ? "\"" + frame_.path.string() + "\" already exists" : "";
}

}  // namespace d2b::tiles
