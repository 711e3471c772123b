#include "write/glb_sink.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "write/face_looks.hpp"
#include "write/field_json.hpp"
#include "write/file_sink.hpp"
#include "write/glb_numbers.hpp"
#include "write/json_list.hpp"
#include "write/surface_file.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

class GlbSink final : public FileSink<SurfaceSink> {
  public:
    GlbSink(RasterPlace place, std::uint64_t most)
        : name_(place.name), most_(most), file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override { meta_ = meta; }
    void add(const SurfacePart& part) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    [[nodiscard]] Json asset() const;
    [[nodiscard]] std::string views() const;
    [[nodiscard]] Json mesh() const;
    void require_room(std::uint64_t bytes) const;

    std::string name_;
    std::uint64_t most_;
    SurfaceFile file_;
    SurfaceMeta meta_;
    JsonList buildings_;  ///< names and attributes
    GlbNumbers numbers_;
};

void GlbSink::require_room(std::uint64_t bytes) const {
    if (bytes > most_)
        throw OutputError(
            "\"" + name_ + "\" would be longer than the " + std::to_string(most_) +
            " bytes that a .glb can have; use a smaller window (-srcwin, -projwin or -te), or write an OBJ.");
}

void GlbSink::add(const SurfacePart& part) {
    for (const SurfaceBuilding& building : part.buildings) {
        const std::uint64_t place =
            buildings_.add({{"name", "building_" + std::to_string(building.id)},
                            {"attributes", field_json(meta_.fields, building.values)}});
        numbers_.add(part, building, meta_.frame, place);
        require_room(numbers_.size());
    }
}

Json GlbSink::asset() const {
    Json extras{{"origin", meta_.frame.origin}};
    if (!meta_.provenance.crs_wkt.empty())
        extras["crs"] = Crs(meta_.provenance.crs_wkt).name();
    for (const auto& [name, value] : meta_.provenance.metadata)
        extras[name] = value;
    return {{"version", "2.0"}, {"generator", "dem2buildings"}, {"extras", std::move(extras)}};
}

/// Returns the buffers, bufferViews, accessors and materials.
std::string GlbSink::views() const {
    const Json buffers = Json::array({{{"byteLength", numbers_.size()}}});
    Json materials = Json::array();
    for (const FaceLook& look : face_looks)
        materials.push_back({{"name", look.name},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {look.colour[0], look.colour[1], look.colour[2], 1}},
                               {"metallicFactor", 0},
                               {"roughnessFactor", 1}}}});
    return "\"buffers\":" + json_text(buffers) + ",\"bufferViews\":" + json_text(numbers_.views()) +
           ",\"accessors\":" + json_text(numbers_.accessors()) + ",\"materials\":" + json_text(materials);
}

/// Uses one primitive per material, because viewers draw a few large lists faster than many small ones.
Json GlbSink::mesh() const {
    Json primitives = Json::array();
    std::uint64_t accessor = 2;
    for (std::size_t kind = 0; kind < face_looks.size(); ++kind)
        if (numbers_.has(static_cast<FaceKind>(kind)))
            primitives.push_back({{"attributes", {{"POSITION", 0}, {"_FEATURE_ID_0", 1}}},
                                  {"indices", accessor++},
                                  {"material", kind}});
    return {{"primitives", std::move(primitives)}};
}

/// Writes the header, then the JSON chunk and the binary chunk, each padded to a multiple of four bytes.
void GlbSink::prepare(CommitList& commit) {
    if (buildings_.count() == 0) {
        file_.leave_out("a glTF without a mesh shows nothing");
        return;
    }
    const std::string begin = "{\"asset\":" + json_text(asset()) +
                              ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}]," + views() + ",\"meshes\":[" +
                              json_text(mesh()) +
                              "],\"nodes\":[{\"name\":\"buildings\",\"mesh\":0,\"extras\":{\"buildings\":[";
    std::string end = "]}}]}";
    std::uint64_t json_size = begin.size() + buildings_.text().size() + end.size();
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
    buildings_.text().write_to(file_);
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
