#include "pipeline/tiles/drawn_tile.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <string_view>

#include "detect/detection.hpp"
#include "features/roof_layer.hpp"
#include "pipeline/polygon_bytes.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::tiles {
namespace {

// Records hold views of these names, which are saved as their numbers.

std::span<const std::string_view> doubts() {
    static const auto names = [] {
        std::array<std::string_view, static_cast<std::size_t>(detect::CounterEvidence::ground) + 1> all;
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = detect::counter_evidence_name(static_cast<detect::CounterEvidence>(i));
        return all;
    }();
    return names;
}

std::span<const std::string_view> face_kinds() {
    static const std::array names{features::face_kind_name(roofs::FaceKind::flat),
                                  features::face_kind_name(roofs::FaceKind::pitched),
                                  features::face_kind_name(roofs::FaceKind::doubtful)};
    return names;
}

/// @param name one of the names, or "", whose number follows those of the others
void save_name(std::string_view name, std::span<const std::string_view> names, ByteWriter& writer) {
    writer.put(static_cast<std::uint8_t>(std::ranges::find(names, name) - names.begin()));
}

std::string_view load_name(ByteReader& reader, std::span<const std::string_view> names) {
    const auto number = reader.take<std::uint8_t>();
    if (number > names.size())
        throw CorruptRecord("a record has an unknown name");
    return number < names.size() ? names[number] : std::string_view();
}

OutlineStatus load_status(ByteReader& reader) {
    const auto status = reader.take<std::uint8_t>();
    if (status > static_cast<std::uint8_t>(OutlineStatus::given))
        throw CorruptRecord("an outline has an unknown status");
    return static_cast<OutlineStatus>(status);
}

void save(const features::FeaturePolygon& polygon, ByteWriter& writer) {
    pipeline::save(polygon.parts, writer);
    writer.put(polygon.measure);
    writer.put(static_cast<std::uint8_t>(polygon.status));
    for (const double value :
         {polygon.deviation, polygon.simplified, polygon.kept_traced, polygon.area_change})
        writer.put(value);
    writer.put_text(polygon.invalid_reason);
    writer.put(static_cast<std::uint8_t>(polygon.split_by_projection ? 1 : 0));
}

features::FeaturePolygon load_polygon(ByteReader& reader) {
    features::FeaturePolygon polygon;
    polygon.parts = pipeline::load_polygons(reader);
    polygon.measure = reader.take<Geodesy::Measure>();
    polygon.status = load_status(reader);
    for (double* value :
         {&polygon.deviation, &polygon.simplified, &polygon.kept_traced, &polygon.area_change})
        *value = reader.take<double>();
    polygon.invalid_reason = reader.take_text();
    polygon.split_by_projection = reader.take<std::uint8_t>() != 0;
    return polygon;
}

void save(const std::optional<features::FeaturePolygon>& polygon, ByteWriter& writer) {
    writer.put(static_cast<std::uint8_t>(polygon ? 1 : 0));
    if (polygon)
        save(*polygon, writer);
}

std::optional<features::FeaturePolygon> load_optional_polygon(ByteReader& reader) {
    if (reader.take<std::uint8_t>() == 0)
        return {};
    return load_polygon(reader);
}

void save(const std::vector<features::DrawnFace>& faces, ByteWriter& writer) {
    writer.put(static_cast<std::uint64_t>(faces.size()));
    for (const features::DrawnFace& face : faces) {
        RoofFaceRecord record = face.record;
        save_name(std::exchange(record.kind, {}), face_kinds(), writer);
        writer.put(record);
        pipeline::save(face.parts, writer);
    }
}

std::vector<features::DrawnFace> load_faces(ByteReader& reader) {
    std::vector<features::DrawnFace> faces(reader.take_count(sizeof(RoofFaceRecord)));
    for (features::DrawnFace& face : faces) {
        const std::string_view kind = load_name(reader, face_kinds());
        if (kind.empty())
            throw CorruptRecord("a face of a roof is of an unknown kind");
        face.record = reader.take<RoofFaceRecord>();
        face.record.kind = kind;
        face.parts = pipeline::load_polygons(reader);
    }
    return faces;
}

/// Throws unless the runs of cells are not empty and have as many cells as there are elevations.
template <typename Run>
void require_elevations(const std::vector<Run>& runs, const std::vector<double>& elevations) {
    std::uint64_t cells = 0;
    for (const Run& run : runs) {
        if (run.begin >= run.end)
            throw CorruptRecord("a run of cells is empty");
        cells += static_cast<std::uint64_t>(std::int64_t{run.end} - run.begin);
    }
    if (cells != elevations.size())
        throw CorruptRecord("there are not as many elevations as cells");
}

void save(const DeferredBuilding& building, ByteWriter& writer) {
    writer.put(building.facts);
    writer.put_list(building.thresholds);
    tiles::save(building.cells, writer);
}

DeferredBuilding load_deferred_building(ByteReader& reader) {
    DeferredBuilding building;
    building.facts = reader.take<JoinedBuilding>();
    building.thresholds = reader.take_list<double>();
    building.cells = load_building_cells(reader);
    return building;
}

void save(const DeferredContour& left, ByteWriter& writer) {
    writer.put(left.head);
    contours::save(left.stored, left.head.key.level, writer);
}

/// @param tile its contours loaded so far
DeferredContour load_deferred_contour(ByteReader& reader, const DrawnTile& tile) {
    DeferredContour left;
    left.head = reader.take<contours::ContourHead>();
    const contours::ContourHead& head = left.head;
    const auto before = static_cast<std::int64_t>(tile.left.size());
    if (head.label == 0 || head.label > tile.deferred_buildings.size() || head.parent < -1 ||
        head.parent >= before || head.key.level < 1 || (head.key.level > 1) != (head.parent >= 0))
        throw CorruptRecord("a contour has no contour below it");
    if (static_cast<std::size_t>(head.key.level) > tile.deferred_buildings[head.label - 1].thresholds.size())
        throw CorruptRecord("a contour is of a level that its building does not have");
    if (head.parent >= 0 &&
        tile.left[static_cast<std::size_t>(head.parent)].head.key.level != head.key.level - 1)
        throw CorruptRecord("a contour stands on one that is not the level below it");
    left.stored = contours::load_stored(head.key.level, reader);
    return left;
}

}  // namespace

void save(const features::DrawnContour& drawn, ByteWriter& writer) {
    writer.put(drawn.key);
    writer.put(drawn.parent);
    writer.put(drawn.building_index);
    writer.put(static_cast<std::uint8_t>(drawn.is_low_confidence ? 1 : 0));
    // The status of records is saved with their polygons, below.
    writer.put(drawn.record);
    writer.put(drawn.own);
    if (drawn.key.level == 1) {
        BuildingRecord record = drawn.building_record;
        save_name(std::exchange(record.doubt, {}), doubts(), writer);
        save_name(std::exchange(record.roof_shape.type, {}), roofs::roof_types, writer);
        record.parcel = {};
        writer.put(record);
        save(drawn.faces, writer);
    }
    save(drawn.building, writer);
    save(drawn.contour, writer);
}

features::DrawnContour load_drawn_contour(ByteReader& reader) {
    features::DrawnContour drawn;
    drawn.key = reader.take<contours::ContourKey>();
    drawn.parent = reader.take<std::int64_t>();
    drawn.building_index = reader.take<std::int64_t>();
    drawn.is_low_confidence = reader.take<std::uint8_t>() != 0;
    drawn.record = reader.take<ContourRecord>();
    drawn.record.status = OutlineStatus::traced;
    drawn.own = reader.take<PointStats>();
    if (drawn.key.level == 1) {
        const std::string_view doubt = load_name(reader, doubts());
        const std::string_view roof_type = load_name(reader, roofs::roof_types);
        drawn.building_record = reader.take<BuildingRecord>();
        drawn.building_record.status = OutlineStatus::traced;
        drawn.building_record.parcel = {};  // restored later from its number
        drawn.building_record.doubt = doubt;
        drawn.building_record.roof_shape.type = roof_type;
        drawn.faces = load_faces(reader);
    }
    drawn.building = load_optional_polygon(reader);
    drawn.contour = load_optional_polygon(reader);
    if (drawn.record.level != drawn.key.level)
        throw CorruptRecord("a contour is not on its level");
    return drawn;
}

void save(const contours::BuildingCells& cells, ByteWriter& writer) {
    writer.put_list(cells.runs);
    writer.put_list(cells.elevations);
}

contours::BuildingCells load_building_cells(ByteReader& reader) {
    contours::BuildingCells cells;
    cells.runs = reader.take_list<RowSpan>();
    cells.elevations = reader.take_list<double>();
    require_elevations(cells.runs, cells.elevations);
    return cells;
}

void save(const DrawnTile& tile, ByteWriter& writer) {
    writer.put(tile.tally);
    writer.put(tile.levels);
    writer.put(tile.buildings);
    writer.put(tile.error);
    writer.put_list(tile.parts);
    writer.put(static_cast<std::uint64_t>(tile.deferred_buildings.size()));
    for (const DeferredBuilding& building : tile.deferred_buildings)
        save(building, writer);
    writer.put(static_cast<std::uint64_t>(tile.left.size()));
    for (const DeferredContour& left : tile.left)
        save(left, writer);
    writer.put_list(tile.cells.runs);
    writer.put_list(tile.cells.elevations);
}

DrawnTile load_drawn_tile(ByteReader& reader) {
    DrawnTile tile;
    tile.tally = reader.take<Tally>();
    tile.levels = reader.take<std::int32_t>();
    tile.buildings = reader.take<std::int64_t>();
    tile.error = reader.take<features::StackError>();
    tile.parts = reader.take_list<features::PartOfWhole>();
    tile.deferred_buildings.resize(reader.take_count(sizeof(JoinedBuilding)));
    for (DeferredBuilding& building : tile.deferred_buildings)
        building = load_deferred_building(reader);
    const std::size_t left = reader.take_count(sizeof(contours::ContourHead));
    for (std::size_t i = 0; i < left; ++i)
        tile.left.push_back(load_deferred_contour(reader, tile));
    tile.cells.runs = reader.take_list<RowSpan>();
    tile.cells.elevations = reader.take_list<double>();
    require_elevations(tile.cells.runs, tile.cells.elevations);
    return tile;
}

void DrawnBlocks::add(const features::DrawnContour& drawn) {
    if (block_.bytes().empty())
        first_ = drawn.key;
    else if (block_.bytes().size() >= usual_bytes || drawn.key.level != first_.level) {
        finish();
        first_ = drawn.key;
    }
    save(drawn, block_);
}

void DrawnBlocks::finish() {
    if (block_.bytes().empty())
        return;
    payload_.add(std::exchange(block_, {}));
    blocks_.push_back({payload_.blocks().back(), first_});
}

std::optional<contours::ContourKey> DrawnStream::key() {
    if (next_)
        return next_->key;
    if (block_) {
        load_next();
        return next_->key;
    }
    if (next_block_ < blocks_.size())
        return blocks_[next_block_].first;
    return {};
}

features::DrawnContour DrawnStream::take() {
    if (!block_)
        load_block();
    if (!next_)
        load_next();
    features::DrawnContour drawn = std::move(*next_);
    next_.reset();
    if (block_->left() == 0)
        block_.reset();
    return drawn;
}

void DrawnStream::load_block() {
    const DrawnBlock& block = blocks_[next_block_++];
    block_.emplace(read_block(file_, begin_, block.bytes));
    begin_ += block.bytes.size;
    load_next();
    if (next_->key != block.first)
        throw InputError(file_.damaged("a block begins with another contour than is announced"));
}

void DrawnStream::load_next() {
    try {
        next_ = std::make_unique<features::DrawnContour>(load_drawn_contour(*block_));
    } catch (const CorruptRecord& broken) {
        throw InputError(file_.damaged(broken.what()));
    }
    if (last_ && !(*last_ < next_->key))
        throw InputError(file_.damaged("its contours are not in order"));
    last_ = next_->key;
}

void save(const NumberedTile& tile, ByteWriter& writer) {
    writer.put_list(tile.numbers.written);
    writer.put_list(tile.numbers.buildings);
    writer.put_list(tile.left);
}

NumberedTile load_numbered_tile(ByteReader& reader) {
    NumberedTile tile;
    tile.numbers.written = reader.take_list<std::int64_t>();
    tile.numbers.buildings = reader.take_list<features::BuildingIds>();
    tile.left = reader.take_list<DrawnBlock>();
    return tile;
}

void NumberedLayer::add(std::int64_t tile, const std::vector<WorldPolygon>& parts) {
    bounds.add(box_of(parts));
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
        writer.put(layer.bounds);
        writer.put_list(layer.tiles);
    }
}

NumberedWhole load_numbered_whole(ByteReader& reader, std::int64_t tiles) {
    NumberedWhole whole;
    whole.levels = reader.take<std::int32_t>();
    if (whole.levels < 1)
        throw CorruptRecord("there is no level");
    whole.layers.resize(reader.take_count(sizeof(std::int64_t)));
    for (NumberedLayer& layer : whole.layers) {
        layer.features = reader.take<std::int64_t>();
        layer.bounds = reader.take<Box>();
        layer.tiles = reader.take_list<std::int64_t>();
        if (std::ranges::adjacent_find(layer.tiles, std::greater_equal<>()) != layer.tiles.end() ||
            (!layer.tiles.empty() && (layer.tiles.front() < 0 || layer.tiles.back() >= tiles)))
            throw CorruptRecord("a layer has parts of tiles that are not in the plan");
    }
    return whole;
}

}  // namespace d2b::tiles
