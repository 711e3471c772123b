#include "write/surface/cityjson_sink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "write/staging.hpp"
#include "write/surface/surface_text.hpp"

namespace d2b::writing {
namespace {

using Json = nlohmann::ordered_json;

/// Indexed by FaceKind.
constexpr std::array surface_types{"RoofSurface", "WallSurface", "GroundSurface"};
/// The planes of a roof come after these.
constexpr int kind_count = surface_types.size();

/// Bounding box of vertices, in steps of the frame.
class Extent {
  public:
    void add(const SurfacePoint& point) {
        low_ = {std::min(low_.x, point.x), std::min(low_.y, point.y), std::min(low_.z, point.z)};
        high_ = {std::max(high_.x, point.x), std::max(high_.y, point.y), std::max(high_.z, point.z)};
    }
    [[nodiscard]] bool is_empty() const { return low_.x > high_.x; }
    /// Minimum x, y, z, then maximum x, y, z, in coordinates of the CRS.
    [[nodiscard]] Json json(const SurfaceFrame& frame) const {
        Json numbers = Json::array();
        for (const SurfacePoint& corner : {low_, high_})
            for (const double at : frame.coordinates(corner))
                numbers.push_back(at);
        return numbers;
    }

  private:
    static constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    SurfacePoint low_{most, most, most};
    SurfacePoint high_{-most, -most, -most};
};

class CityJsonSink final : public FileSink<SurfaceSink> {
  public:
    explicit CityJsonSink(FileDestination place) : file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::solids; }
    void preflight(const SurfaceMeta& meta) override;
    void begin(const SurfaceMeta& meta) override;
    void add(const SurfacePart& part) override;
    void end_group() override { vertex_indices_.clear(); }
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    [[nodiscard]] std::uint64_t vertex_index(const SurfacePoint& point);
    [[nodiscard]] Json solid(const SurfaceBuilding& building,
                             const std::vector<std::uint64_t>& numbers) const;
    void write_object(const std::string& name, const Json& object);
    [[nodiscard]] Json metadata() const;

    FileWriter file_;
    SurfaceMeta meta_;
    std::string url_;       // URL of the CRS
    SpillBuffer vertices_;  // JSON list without its brackets
    std::uint64_t vertex_count_ = 0;
    std::map<std::string, std::vector<std::string>> parts_;  // names of parts by name of the divided building
    std::map<SurfacePoint, std::uint64_t> vertex_indices_;   // vertex numbers, shared by buildings that touch
    Extent extent_;
    bool has_any_ = false;
};

/// Throws unless heights have the unit of x and y, because CityJSON cannot state a second unit.
void CityJsonSink::preflight(const SurfaceMeta& meta) {
    constexpr double same = 1e-9;
    if (meta.vertical_unit.empty())
        throw OptionError(
            "CityJSON has heights in the unit of x and y, and the unit of the elevations is unknown; give it "
            "with -zunit and, if x and y have another unit, a CRS in that unit with -t_srs.");
    const SurfaceFrame& frame = meta.frame;
    if (std::abs(frame.horizontal_metres / frame.vertical_metres - 1) < same)
        return;
    const Crs crs(meta.provenance.crs_wkt);
    const auto unit = crs.horizontal_unit();
    throw OptionError("CityJSON has heights in the unit of x and y, which is the " +
                      (unit ? unit->name : std::string("metre")) +
                      (crs.name().empty() ? "" : " in '" + crs.name() + "'") +
                      ", and the elevations are in the unit '" + meta.vertical_unit +
                      "'; give a CRS in that unit with -t_srs, or their true unit with -zunit.");
}

void CityJsonSink::begin(const SurfaceMeta& meta) {
    meta_ = meta;
    const Crs crs(meta.provenance.crs_wkt);
    url_ = crs.url();
    if (url_.empty() && crs.kind() != Crs::Kind::none) {
        url_ = crs.horizontal_url();
        file_.warn("A CityJSON names its CRS by the code of an authority, and '" + crs.name() +
                   "' has none; the file " +
                   (url_.empty() ? "does not say what its CRS is."
                                 : "names only the horizontal part, and does not say where its heights "
                                   "begin."));
    }
    const Json transform{{"scale", meta.frame.scale}, {"translate", meta.frame.translate}};
    file_.write("{\"type\":\"CityJSON\",\"version\":\"2.0\",\n\"transform\":" + json_text(transform) +
                ",\n\"CityObjects\":{");
}

std::uint64_t CityJsonSink::vertex_index(const SurfacePoint& point) {
    const auto [found, is_new] = vertex_indices_.try_emplace(point, vertex_count_);
    if (is_new) {
        vertices_.add((vertex_count_++ == 0 ? "\n[" : ",\n[") + std::to_string(point.x) + "," +
                      std::to_string(point.y) + "," + std::to_string(point.z) + "]");
        extent_.add(point);
    }
    return found->second;
}

Json CityJsonSink::solid(const SurfaceBuilding& building, const std::vector<std::uint64_t>& numbers) const {
    Json shell = Json::array();
    Json kinds = Json::array();
    const auto numbered = [&](const std::vector<std::uint32_t>& ring) {
        Json list = Json::array();
        for (const std::uint32_t corner : ring)
            list.push_back(numbers[corner]);
        return list;
    };
    for (const SurfaceFace& face : building.faces) {
        Json rings = Json::array({numbered(face.exterior)});
        for (const std::vector<std::uint32_t>& ring : face.interiors)
            rings.push_back(numbered(ring));
        shell.push_back(std::move(rings));
        kinds.push_back(face.roof < 0 ? static_cast<int>(face.kind) : kind_count + face.roof);
    }
    Json surfaces = Json::array();
    for (const char* type : surface_types)
        surfaces.push_back({{"type", type}});
    for (const SurfaceRoofPlane& roof : building.roofs) {
        Json surface{{"type", surface_types[static_cast<std::size_t>(FaceKind::roof)]},
                     {"slope", std::round(roof.slope * 100) / 100}};
        if (!std::isnan(roof.azimuth))
            surface["azimuth"] = std::fmod(std::round(roof.azimuth * 100) / 100, 360);
        surfaces.push_back(std::move(surface));
    }
    return {{"type", "Solid"},
            {"lod", meta_.lod},
            {"boundaries", Json::array({std::move(shell)})},
            {"semantics", {{"surfaces", std::move(surfaces)}, {"values", Json::array({std::move(kinds)})}}}};
}

void CityJsonSink::add(const SurfacePart& part) {
    std::vector<std::uint64_t> numbers;
    numbers.reserve(part.points.size());
    for (const SurfacePoint& point : part.points)
        numbers.push_back(vertex_index(point));
    for (const SurfaceBuilding& building : part.buildings) {
        const std::string name = "building_" + std::to_string(building.id);
        Json object;
        object["type"] = building.whole == 0 ? "Building" : "BuildingPart";
        if (building.whole != 0) {
            const std::string whole = "whole_" + std::to_string(building.whole);
            object["parents"] = Json::array({whole});
            parts_[whole].push_back(name);
        }
        object["attributes"] = field_json(meta_.fields, building.values);
        object["geometry"] = Json::array({solid(building, numbers)});
        write_object(name, object);
    }
}

void CityJsonSink::write_object(const std::string& name, const Json& object) {
    file_.write((has_any_ ? ",\n\"" : "\n\"") + name + "\":" + json_text(object));
    has_any_ = true;
}

Json CityJsonSink::metadata() const {
    Json metadata = Json::object();
    if (!extent_.is_empty())
        metadata["geographicalExtent"] = extent_.json(meta_.frame);
    if (!url_.empty())
        metadata["referenceSystem"] = url_;
    return metadata;
}

void CityJsonSink::prepare(CommitList& commit) {
    for (const auto& [name, parts] : parts_)
        write_object(name, {{"type", "Building"}, {"children", parts}});
    file_.write("},\n\"vertices\":[");
    vertices_.write_to(file_);
    file_.write("],\n\"metadata\":" + json_text(metadata()) + "}\n");
    file_.prepare(commit);
}

}  // namespace

std::unique_ptr<SurfaceSink> open_cityjson_sink(FileDestination place) {
    return std::make_unique<CityJsonSink>(std::move(place));
}

}  // namespace d2b::writing
