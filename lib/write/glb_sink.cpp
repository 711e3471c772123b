#include "write/glb_sink.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "write/field_json.hpp"
#include "write/file_sink.hpp"
#include "write/glb_numbers.hpp"
#include "write/json_list.hpp"
#include "write/surface_file.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

struct Look {
    const char* name;
    std::array<double, 4> colour;  ///< linear red, green, blue, and opaque
};
/// By FaceKind.
constexpr std::array looks{Look{"roof", {0.45, 0.09, 0.05, 1}}, Look{"wall", {0.6, 0.57, 0.5, 1}},
                           Look{"ground", {0.2, 0.2, 0.2, 1}}};

class GlbSink final : public FileSink<SurfaceSink> {
  public:
    GlbSink(RasterPlace place, std::uint64_t most)
        : name_(place.name), most_(most), file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override { meta_ = meta; }
    void add(const SurfacePart& part) override {
        for (const SurfaceBuilding& building : part.buildings)
            add_building(part, building);
    }
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    void add_building(const SurfacePart& part, const SurfaceBuilding& building);
    [[nodiscard]] Json asset() const;
    [[nodiscard]] std::string views() const;
    [[nodiscard]] std::string scene() const;
    void require_room(std::uint64_t bytes) const;

    std::string name_;
    std::uint64_t most_;
    SurfaceFile file_;
    SurfaceMeta meta_;
    JsonList nodes_;
    JsonList meshes_;
    GlbNumbers numbers_;
};

void GlbSink::require_room(std::uint64_t bytes) const {
    if (bytes > most_)
        throw OutputError(
            "\"" + name_ + "\" would be longer than the " + std::to_string(most_) +
            " bytes that a .glb can have; use a smaller window (-srcwin, -projwin or -te), or write an OBJ.");
}

void GlbSink::add_building(const SurfacePart& part, const SurfaceBuilding& building) {
    const GlbCorners corners(building);
    const std::uint64_t positions = numbers_.add_positions(part, meta_.frame, corners);
    Json primitives = Json::array();
    for (std::size_t kind = 0; kind < looks.size(); ++kind)
        if (std::ranges::find(building.triangles, static_cast<FaceKind>(kind), &SurfaceTriangle::kind) !=
            building.triangles.end())
            primitives.push_back(
                {{"attributes", {{"POSITION", positions}}},
                 {"indices", numbers_.add_indices(building, static_cast<FaceKind>(kind), corners)},
                 {"material", kind}});
    const std::uint64_t mesh = meshes_.add({{"primitives", std::move(primitives)}});
    nodes_.add({{"name", "building_" + std::to_string(building.id)},
                {"mesh", mesh},
                {"extras", field_json(meta_.fields, building.values)}});
    require_room(numbers_.size());
}

Json GlbSink::asset() const {
    Json extras{{"origin", meta_.frame.origin}};
    if (!meta_.provenance.crs_wkt.empty())
        extras["crs"] = Crs(meta_.provenance.crs_wkt).name();
    for (const auto& [name, value] : meta_.provenance.metadata)
        extras[name] = value;
    return {{"version", "2.0"}, {"generator", "dem2buildings"}, {"extras", std::move(extras)}};
}

/// Where the numbers of all buildings lie, and what faces look like.
std::string GlbSink::views() const {
    const Json buffers = Json::array({{{"byteLength", numbers_.size()}}});
    Json materials = Json::array();
    for (const Look& look : looks)
        materials.push_back(
            {{"name", look.name},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", look.colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
    return "\"buffers\":" + json_text(buffers) + ",\"bufferViews\":" + json_text(numbers_.views()) +
           ",\"materials\":" + json_text(materials);
}

std::string GlbSink::scene() const {
    std::string text = "\"scene\":0,\"scenes\":[{\"nodes\":[";
    for (std::uint64_t node = 0; node < nodes_.count(); ++node)
        text += (node == 0 ? "" : ",") + std::to_string(node);
    return text + "]}]";
}

/// A header, then a chunk of JSON and one of numbers, each a multiple of four bytes long.
void GlbSink::prepare(CommitList& commit) {
    if (nodes_.count() == 0) {
        file_.leave_out("a glTF without a mesh shows nothing");
        return;
    }
    const std::string begin = "{\"asset\":" + json_text(asset()) + "," + scene() + "," + views();
    std::string end = "]}";
    const std::array<std::pair<const char*, JsonList*>, 3> lists{
        {{",\"nodes\":[", &nodes_},
         {"],\"meshes\":[", &meshes_},
         {"],\"accessors\":[", &numbers_.accessors()}}};
    std::uint64_t json_size = begin.size() + end.size();
    for (const auto& [name, list] : lists)
        json_size += std::string(name).size() + list->text().size();
    end.append((4 - json_size % 4) % 4, ' ');
    json_size += (4 - json_size % 4) % 4;
    const std::uint64_t bin_size = numbers_.size();
    const std::uint64_t size = 12 + 8 + json_size + 8 + bin_size;
    require_room(size);

    std::string header = "glTF";
    append_number(2, header);
    append_number(static_cast<std::uint32_t>(size), header);
    append_number(static_cast<std::uint32_t>(json_size), header);
    file_.write(header + "JSON" + begin);
    for (const auto& [name, list] : lists) {
        file_.write(name);
        list->text().write_to(file_);
    }
    append_number(static_cast<std::uint32_t>(bin_size), end);
    file_.write(end + "BIN" + '\0');
    numbers_.write_to(file_);
    file_.prepare(commit);
}

}  // namespace

std::unique_ptr<SurfaceSink> open_glb_sink(RasterPlace place, std::uint64_t most) {
    return std::make_unique<GlbSink>(std::move(place), most);
}

}  // namespace d2b
