#include "cli/read_obj.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

namespace d2b::test {
namespace {

using Vector = std::array<double, 3>;

Vector wide(const ReadObj::Corner& corner) {
    return {static_cast<double>(corner[0]), static_cast<double>(corner[1]), static_cast<double>(corner[2])};
}

Vector minus(const ReadObj::Corner& a, const ReadObj::Corner& b) {
    const Vector from = wide(b);
    const Vector to = wide(a);
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector normal(const ReadObj::Triangle& t) {
    return cross(minus(t[1], t[0]), minus(t[2], t[0]));
}

template <typename Visit>
void for_each(const ReadObj& obj, const Visit& visit) {
    for (const auto& [name, triangles] : obj.groups)
        for (const ReadObj::Triangle& triangle : triangles)
            visit(name, triangle);
}

}  // namespace

int ReadObj::open_edges() const {
    std::map<std::pair<Corner, Corner>, int> ways;
    for_each(*this, [&](const std::string& /*name*/, const Triangle& t) {
        for (std::size_t i = 0; i < 3; ++i)
            ++ways[{t[i], t[(i + 1) % 3]}];
    });
    int open = 0;
    for (const auto& [way, count] : ways) {
        const auto back = ways.find({way.second, way.first});
        open += count != 1 || back == ways.end() || back->second != 1 ? 1 : 0;
    }
    return open;
}

int ReadObj::flat_triangles() const {
    int flat = 0;
    for_each(*this, [&](const std::string& /*name*/, const Triangle& t) {
        flat += normal(t) == Vector{0, 0, 0} ? 1 : 0;
    });
    return flat;
}

/// Uses cones from one of its own corners, because those from far away would lose all digits.
double ReadObj::volume() const {
    const Corner from = groups.empty() ? Corner{} : groups.begin()->second.at(0)[0];
    double sum = 0;
    for_each(*this, [&](const std::string& /*name*/, const Triangle& t) {
        const Vector n = normal(t);
        const Vector at = minus(t[0], from);
        sum += n[0] * at[0] + n[1] * at[1] + n[2] * at[2];
    });
    return sum / 6;
}

double ReadObj::plan_area(const std::string& ending) const {
    double sum = 0;
    for_each(*this, [&](const std::string& name, const Triangle& t) {
        sum += name.ends_with(ending) ? normal(t)[2] / 2 : 0;
    });
    return sum;
}

std::array<float, 2> ReadObj::heights(const std::string& beginning) const {
    std::array<float, 2> range{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
    for_each(*this, [&](const std::string& name, const Triangle& t) {
        for (const Corner& corner : t)
            if (name.starts_with(beginning))
                range = {std::min(range[0], corner[2]), std::max(range[1], corner[2])};
    });
    return range;
}

std::vector<std::string> ReadObj::objects() const {
    std::set<std::string> names;
    for (const auto& [name, triangles] : groups)
        names.insert(name.substr(0, name.find('/')));
    return {names.begin(), names.end()};
}

ReadObj read_obj(const std::string& path) {
    ReadObj obj;
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::vector<ReadObj::Corner> corners;
    std::string object;
    std::string group;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "#") {
            obj.comments.push_back(line);
        } else if (word == "o") {
            words >> object;
        } else if (word == "g") {
            words >> group;
        } else if (word == "v") {
            ReadObj::Corner& corner = corners.emplace_back();
            words >> corner[0] >> corner[1] >> corner[2];
        } else if (word == "f") {
            ReadObj::Triangle triangle;
            for (ReadObj::Corner& corner : triangle) {
                std::size_t number = 0;
                words >> number;
                corner = corners.at(number - 1);
            }
            obj.groups[object + "/" + group].push_back(triangle);
        } else if (word == "mtllib") {
            words >> obj.materials;
        } else if (word == "usemtl") {
            std::string material;
            words >> material;
            EXPECT_EQ(material, group);
        } else {
            ADD_FAILURE() << line;
        }
        EXPECT_FALSE(words.fail()) << line;
    }
    return obj;
}

}  // namespace d2b::test
