#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/read_obj.hpp"

namespace d2b::test {
namespace {

using Json = nlohmann::json;

class Bytes {
  public:
    explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}

    [[nodiscard]] std::uint32_t number(std::size_t at) const {
        std::uint32_t number = 0;
        for (std::size_t i = 0; i < 4; ++i)
            number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_.at(at + i))) << (8 * i);
        return number;
    }
    [[nodiscard]] std::string text(std::size_t at, std::size_t size) const { return bytes_.substr(at, size); }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  private:
    std::string bytes_;
};

class GlbReader {
  public:
    explicit GlbReader(const Bytes& bytes) : bytes_(bytes) {
        EXPECT_EQ(bytes.text(0, 4), "glTF");
        EXPECT_EQ(bytes.number(4), 2U);
        EXPECT_EQ(bytes.number(8), bytes.size());
        const std::size_t json_size = bytes.number(12);
        EXPECT_EQ(bytes.text(16, 4), "JSON");
        EXPECT_EQ(json_size % 4, 0U);
        root_ = Json::parse(bytes.text(20, json_size));
        bin_ = 20 + json_size + 8;
        EXPECT_EQ(bytes.text(bin_ - 4, 4), std::string("BIN\0", 4));
        EXPECT_EQ(bin_ + bytes.number(bin_ - 8), bytes.size());
        EXPECT_EQ(root_.at("buffers").at(0).at("byteLength"), bytes.size() - bin_);
    }
    [[nodiscard]] ReadObj read() const {
        EXPECT_EQ(root_.at("asset").at("version"), "2.0");
        ReadObj glb;
        glb.comments.push_back(root_.at("asset").at("extras").dump());
        EXPECT_EQ(root_.at("scenes").at(0).at("nodes"), Json::array({0}));
        EXPECT_EQ(root_.at("nodes").size(), 1U);
        EXPECT_EQ(root_.at("meshes").size(), 1U);
        const Json& buildings = root_.at("nodes").at(0).at("extras").at("buildings");
        for (const Json& building : buildings)
            glb.comments.push_back(building.at("attributes").dump());
        std::set<std::size_t> materials;
        for (const Json& primitive : root_.at("meshes").at(0).at("primitives")) {
            const auto material = primitive.at("material").get<std::size_t>();
            EXPECT_TRUE(materials.insert(material).second) << "two primitives of one material";
            const std::string group = "/" + root_.at("materials").at(material).at("name").get<std::string>();
            for (const auto& [building, triangle] : triangles(primitive))
                glb.groups[buildings.at(building).at("name").get<std::string>() + group].push_back(triangle);
        }
        return glb;
    }

  private:
    /// Place at which the numbers of an accessor begin.
    [[nodiscard]] std::size_t begin(const Json& accessor, int type, int stride) const {
        EXPECT_EQ(accessor.at("componentType"), type);
        const Json& view = root_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        const auto offset = accessor.value("byteOffset", std::size_t{0});
        EXPECT_LE(offset + accessor.at("count").get<std::size_t>() * static_cast<std::size_t>(stride),
                  view.at("byteLength").get<std::size_t>());
        return bin_ + view.value("byteOffset", std::size_t{0}) + offset;
    }
    /// Triangles with the place of the building that all corners of each belong to.
    [[nodiscard]] std::vector<std::pair<std::size_t, ReadObj::Triangle>> triangles(
        const Json& primitive) const {
        const auto accessor = [&](const Json& number) -> const Json& {
            return root_.at("accessors").at(number.get<std::size_t>());
        };
        const Json& positions = accessor(primitive.at("attributes").at("POSITION"));
        const Json& features = accessor(primitive.at("attributes").at("_FEATURE_ID_0"));
        const Json& indices = accessor(primitive.at("indices"));
        EXPECT_EQ(features.at("count"), positions.at("count"));
        EXPECT_EQ(features.at("type"), "SCALAR");
        const std::size_t at = begin(positions, 5126, 12);
        const std::size_t numbers = begin(indices, 5125, 4);
        const std::size_t places = begin(features, 5126, 4);
        std::vector<std::pair<std::size_t, ReadObj::Triangle>> triangles(
            indices.at("count").get<std::size_t>() / 3);
        for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
            const std::size_t corner = bytes_.number(numbers + 4 * i);
            EXPECT_LT(corner, positions.at("count").get<std::size_t>());
            std::array<float, 3> p{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[axis] = std::bit_cast<float>(bytes_.number(at + 12 * corner + 4 * axis));
                EXPECT_GE(p[axis], positions.at("min").at(axis).get<float>());
                EXPECT_LE(p[axis], positions.at("max").at(axis).get<float>());
            }
            const auto building =
                static_cast<std::size_t>(std::bit_cast<float>(bytes_.number(places + 4 * corner)));
            auto& [of, triangle] = triangles[i / 3];
            EXPECT_TRUE(i % 3 == 0 || of == building) << "a triangle of two buildings";
            of = building;
            triangle[i % 3] = {p[0], -p[2], p[1]};
        }
        return triangles;
    }

    const Bytes& bytes_;
    Json root_;
    std::size_t bin_ = 0;  // where its numbers begin
};

}  // namespace

ReadObj read_glb(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    const Bytes bytes(std::string(std::istreambuf_iterator<char>(file), {}));
    return GlbReader(bytes).read();
}

}  // namespace d2b::test
