#include "tiles/drawn_contour.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "detect/detection.hpp"

namespace d2b {
namespace {

constexpr std::array doubts{Doubt::rough, Doubt::no_step,         Doubt::steep, Doubt::pieces,
                            Doubt::green, Doubt::no_right_angles, Doubt::ragged};

std::uint8_t number_of(std::string_view doubt) {
    std::uint8_t number = 0;
    for (const Doubt known : doubts) {
        if (doubt_name(known) == doubt)
            break;
        ++number;
    }
    return number;
}

OutlineStatus load_status(ByteReader& reader) {
    const auto status = reader.take<std::uint8_t>();
    if (status > static_cast<std::uint8_t>(OutlineStatus::repaired))
        throw BrokenRecord("an outline has no known status");
    return static_cast<OutlineStatus>(status);
}

void save(const WorldPolygon& part, ByteWriter& writer) {
    writer.put_list(part.exterior);
    writer.put(static_cast<std::uint64_t>(part.interiors.size()));
    for (const WorldRing& ring : part.interiors)
        writer.put_list(ring);
    writer.put_list(part.arcs);
}

WorldPolygon load_part(ByteReader& reader) {
    WorldPolygon part;
    part.exterior = reader.take_list<Position>();
    part.interiors.resize(reader.take_count(sizeof(std::uint64_t)));
    for (WorldRing& ring : part.interiors)
        ring = reader.take_list<Position>();
    part.arcs = reader.take_list<CircularArc>();
    return part;
}

void save(const FeaturePolygon& made, ByteWriter& writer) {
    writer.put(static_cast<std::uint64_t>(made.parts.size()));
    for (const WorldPolygon& part : made.parts)
        save(part, writer);
    writer.put(made.measure);
    writer.put(static_cast<std::uint8_t>(made.status));
    for (const double value : {made.deviation, made.simplified, made.kept_traced, made.area_change})
        writer.put(value);
    writer.put_list(std::vector<char>(made.trouble.begin(), made.trouble.end()));
    writer.put(static_cast<std::uint8_t>(made.torn ? 1 : 0));
}

FeaturePolygon load_polygon(ByteReader& reader) {
    FeaturePolygon made;
    made.parts.resize(reader.take_count(sizeof(std::uint64_t)));
    for (WorldPolygon& part : made.parts)
        part = load_part(reader);
    made.measure = reader.take<Geodesy::Measure>();
    made.status = load_status(reader);
    for (double* value : {&made.deviation, &made.simplified, &made.kept_traced, &made.area_change})
        *value = reader.take<double>();
    const auto trouble = reader.take_list<char>();
    made.trouble.assign(trouble.begin(), trouble.end());
    made.torn = reader.take<std::uint8_t>() != 0;
    return made;
}

void save(const std::optional<FeaturePolygon>& made, ByteWriter& writer) {
    writer.put(static_cast<std::uint8_t>(made ? 1 : 0));
    if (made)
        save(*made, writer);
}

std::optional<FeaturePolygon> load_if_made(ByteReader& reader) {
    if (reader.take<std::uint8_t>() == 0)
        return {};
    return load_polygon(reader);
}

}  // namespace

void save(const DrawnContour& drawn, ByteWriter& writer) {
    writer.put(drawn.key);
    writer.put(drawn.parent);
    writer.put(drawn.building_place);
    writer.put(static_cast<std::uint8_t>(drawn.is_doubtful ? 1 : 0));
    // The status of records is saved with their polygons, below.
    writer.put(drawn.record);
    writer.put(drawn.own);
    if (drawn.key.level == 1) {
        BuildingRecord record = drawn.building_record;
        writer.put(number_of(std::exchange(record.doubt, {})));
        record.parcel = {};
        writer.put(record);
    }
    save(drawn.building, writer);
    save(drawn.contour, writer);
}

DrawnContour load_drawn_contour(ByteReader& reader) {
    DrawnContour drawn;
    drawn.key = reader.take<ContourKey>();
    drawn.parent = reader.take<std::int64_t>();
    drawn.building_place = reader.take<std::int64_t>();
    drawn.is_doubtful = reader.take<std::uint8_t>() != 0;
    drawn.record = reader.take<ContourRecord>();
    drawn.record.status = OutlineStatus::traced;
    drawn.own = reader.take<PointStats>();
    if (drawn.key.level == 1) {
        const auto doubt = reader.take<std::uint8_t>();
        drawn.building_record = reader.take<BuildingRecord>();
        drawn.building_record.status = OutlineStatus::traced;
        drawn.building_record.parcel = {};  // restored later from its number
        drawn.building_record.doubt = doubt < doubts.size() ? doubt_name(doubts[doubt]) : std::string_view();
    }
    drawn.building = load_if_made(reader);
    drawn.contour = load_if_made(reader);
    if (drawn.record.level != drawn.key.level)
        throw BrokenRecord("a contour is not on its level");
    return drawn;
}

}  // namespace d2b
