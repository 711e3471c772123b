#include "write/surface/glb_sink.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "write/staging.hpp"
#include "write/surface/obj_stl_sink.hpp"
#include "write/surface/surface_text.hpp"

namespace d2b::writing {

/// Appends four bytes, little-endian.
void append_uint32(std::uint32_t number, std::string& bytes);

/// Binary buffers of a glTF: vertex positions of all buildings, the building index per vertex, then the
/// triangles per kind of face.
class GlbBuffers {
  public:
    /// Appends a building in single precision, y up, z to the south. @param place index of the building in
    /// the list of all
    void add(const SurfacePart& part, const SurfaceBuilding& building, const SurfaceFrame& frame,
             std::uint64_t place);

    [[nodiscard]] bool has(FaceKind kind) const { return indices_[index(kind)].size() > 0; }
    /// Total size in bytes.
    [[nodiscard]] std::uint64_t size() const;
    /// Returns the bufferViews of glTF.
    [[nodiscard]] nlohmann::ordered_json views() const;
    /// Returns the accessors of glTF: positions, building indices, then the kinds of faces in use.
    [[nodiscard]] nlohmann::ordered_json accessors() const;
    /// @throws OutputError
    void write_to(FileWriter& file);

  private:
    static constexpr std::size_t kinds = 3;
    [[nodiscard]] static std::size_t index(FaceKind kind) { return static_cast<std::size_t>(kind); }

    SpillBuffer positions_;
    SpillBuffer buildings_;
    std::array<SpillBuffer, kinds> indices_;
    std::uint32_t corners_ = 0;
    std::array<float, 3> low_{};
    std::array<float, 3> high_{};
};

namespace {

using Json = nlohmann::ordered_json;

// Constants of glTF 2.0.
constexpr int type_float = 5126;
constexpr int type_unsigned_int = 5125;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;
constexpr std::uint64_t number_size = 4;

/// Returns the ascending vertex indices of a building in its part.
std::vector<std::uint32_t> used_corners(const SurfaceBuilding& building) {
    std::vector<std::uint32_t> used;
    for (const SurfaceTriangle& triangle : building.triangles)
        used.insert(used.end(), triangle.corners.begin(), triangle.corners.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

class GlbSink final : public FileSink<SurfaceSink> {
  public:
    GlbSink(FileDestination place, std::uint64_t most) : most_(most), file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override { meta_ = meta; }
    void add(const SurfacePart& part) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    [[nodiscard]] Json asset() const;
    [[nodiscard]] std::string views() const;
    [[nodiscard]] Json mesh() const;
    void check_size(std::uint64_t bytes) const;

    std::uint64_t most_;
    FileWriter file_;
    SurfaceMeta meta_;
    std::uint64_t building_count_ = 0;
    SpillBuffer buildings_;  ///< names and attributes, as a JSON list without its brackets
    GlbBuffers numbers_;
};

void GlbSink::check_size(std::uint64_t bytes) const {
    if (bytes > most_)
        throw OutputError(
            "\"" + file_.name() + "\" would be longer than the " + std::to_string(most_) +
            " bytes that a .glb can have; use a smaller window (-srcwin, -projwin or -te), or write an OBJ.");
}

void GlbSink::add(const SurfacePart& part) {
    for (const SurfaceBuilding& building : part.buildings) {
        const Json item{{"name", "building_" + std::to_string(building.id)},
                        {"attributes", field_json(meta_.fields, building.values)}};
        buildings_.add((building_count_ == 0 ? "" : ",") + json_text(item));
        numbers_.add(part, building, meta_.frame, building_count_++);
        check_size(numbers_.size());
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
    for (const FaceMaterial& look : face_materials)
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
    for (std::size_t kind = 0; kind < face_materials.size(); ++kind)
        if (numbers_.has(static_cast<FaceKind>(kind)))
            primitives.push_back({{"attributes", {{"POSITION", 0}, {"_FEATURE_ID_0", 1}}},
                                  {"indices", accessor++},
                                  {"material", kind}});
    return {{"primitives", std::move(primitives)}};
}

/// Writes the header, then the JSON chunk and the binary chunk, each padded to a multiple of four bytes.
void GlbSink::prepare(CommitList& commit) {
    if (building_count_ == 0) {
        warn_of_no_building(file_, "a glTF without a mesh shows nothing");
        return;
    }
    const std::string begin = "{\"asset\":" + json_text(asset()) +
                              ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}]," + views() + ",\"meshes\":[" +
                              json_text(mesh()) +
                              "],\"nodes\":[{\"name\":\"buildings\",\"mesh\":0,\"extras\":{\"buildings\":[";
    std::string end = "]}}]}";
    std::uint64_t json_size = begin.size() + buildings_.size() + end.size();
    end.append((4 - json_size % 4) % 4, ' ');
    json_size += (4 - json_size % 4) % 4;
    const std::uint64_t bin_size = numbers_.size();
    const std::uint64_t size = 12 + 8 + json_size + 8 + bin_size;
    check_size(size);

    std::string header = "glTF";
    append_uint32(2, header);
    append_uint32(static_cast<std::uint32_t>(size), header);
    append_uint32(static_cast<std::uint32_t>(json_size), header);
    file_.write(header + "JSON" + begin);
    buildings_.write_to(file_);
    append_uint32(static_cast<std::uint32_t>(bin_size), end);
    file_.write(end + "BIN" + '\0');
    numbers_.write_to(file_);
    file_.prepare(commit);
}

}  // namespace

void append_uint32(std::uint32_t number, std::string& bytes) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(number >> shift & 0xFFU);
}

void GlbBuffers::add(const SurfacePart& part, const SurfaceBuilding& building, const SurfaceFrame& frame,
                     std::uint64_t place) {
    const std::vector<std::uint32_t> used = used_corners(building);
    std::string positions;
    std::string buildings;
    for (const std::uint32_t corner : used) {
        const std::array<double, 3> local = frame.local(part.points[corner]);
        const std::array<float, 3> at{static_cast<float>(local[0]), static_cast<float>(local[2]),
                                      static_cast<float>(0 - local[1])};
        const bool is_first = positions_.size() == 0 && positions.empty();
        for (std::size_t i = 0; i < at.size(); ++i) {
            low_[i] = is_first ? at[i] : std::min(low_[i], at[i]);
            high_[i] = is_first ? at[i] : std::max(high_[i], at[i]);
        }
        for (const float number : at)
            append_uint32(std::bit_cast<std::uint32_t>(number), positions);
        append_uint32(std::bit_cast<std::uint32_t>(static_cast<float>(place)), buildings);
    }
    positions_.add(positions);
    buildings_.add(buildings);
    std::array<std::string, kinds> indices;
    for (const SurfaceTriangle& triangle : building.triangles)
        for (const std::uint32_t corner : triangle.corners)
            append_uint32(
                corners_ + static_cast<std::uint32_t>(std::ranges::lower_bound(used, corner) - used.begin()),
                indices[index(triangle.kind)]);
    for (std::size_t kind = 0; kind < kinds; ++kind)
        indices_[kind].add(indices[kind]);
    corners_ += static_cast<std::uint32_t>(used.size());
}

std::uint64_t GlbBuffers::size() const {
    std::uint64_t size = positions_.size() + buildings_.size();
    for (const SpillBuffer& indices : indices_)
        size += indices.size();
    return size;
}

Json GlbBuffers::views() const {
    const std::uint64_t vertices = positions_.size() + buildings_.size();
    return Json::array({{{"buffer", 0},
                         {"byteLength", positions_.size()},
                         {"byteStride", 3 * number_size},
                         {"target", target_vertices}},
                        {{"buffer", 0},
                         {"byteOffset", positions_.size()},
                         {"byteLength", buildings_.size()},
                         {"byteStride", number_size},
                         {"target", target_vertices}},
                        {{"buffer", 0},
                         {"byteOffset", vertices},
                         {"byteLength", size() - vertices},
                         {"target", target_indices}}});
}

Json GlbBuffers::accessors() const {
    Json accessors = Json::array(
        {{{"bufferView", 0},
          {"componentType", type_float},
          {"count", corners_},
          {"type", "VEC3"},
          {"min", low_},
          {"max", high_}},
         {{"bufferView", 1}, {"componentType", type_float}, {"count", corners_}, {"type", "SCALAR"}}});
    std::uint64_t begin = 0;
    for (const SpillBuffer& indices : indices_) {
        if (indices.size() > 0)
            accessors.push_back({{"bufferView", 2},
                                 {"byteOffset", begin},
                                 {"componentType", type_unsigned_int},
                                 {"count", indices.size() / number_size},
                                 {"type", "SCALAR"}});
        begin += indices.size();
    }
    return accessors;
}

void GlbBuffers::write_to(FileWriter& file) {
    positions_.write_to(file);
    buildings_.write_to(file);
    for (SpillBuffer& indices : indices_)
        indices.write_to(file);
}

std::unique_ptr<SurfaceSink> open_glb_sink(FileDestination place, std::uint64_t most) {
    return std::make_unique<GlbSink>(std::move(place), most);
}

}  // namespace d2b::writing
