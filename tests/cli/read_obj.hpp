#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace d2b::test {

/// A Wavefront OBJ as a program reads it that knows nothing of ours. Coordinates have single precision.
struct ReadObj {
    using Corner = std::array<float, 3>;
    using Triangle = std::array<Corner, 3>;

    std::vector<std::string> comments;
    std::string materials;  ///< the file of an OBJ that has them
    /// The triangles of each group of each object: "building_7/roof".
    std::map<std::string, std::vector<Triangle>> groups;

    /// How many edges are not passed once each way, where equal corners are one.
    [[nodiscard]] int open_edges() const;
    [[nodiscard]] int flat_triangles() const;
    /// Volume that the triangles enclose.
    [[nodiscard]] double volume() const;
    /// Area as seen from above, of the groups with names that end so.
    [[nodiscard]] double plan_area(const std::string& ending) const;
    /// The lowest and the highest corner of the groups with names that begin so.
    [[nodiscard]] std::array<float, 2> heights(const std::string& beginning) const;
    [[nodiscard]] std::vector<std::string> objects() const;
};

/// Fails the test where a line is none of an OBJ.
[[nodiscard]] ReadObj read_obj(const std::string& path);

/// An ASCII STL: a solid is a group, its `solid` line a comment. Fails the test where it is none, or where a
/// normal is not that of its facet.
[[nodiscard]] ReadObj read_stl(const std::string& path);

/// A binary glTF, with z up as in the others: groups are buildings and the materials of their triangles,
/// comments the extras of the asset and then the attributes of each building, as JSON. Fails the test where
/// it is none of version 2.0, has more than a primitive for each material, or has a number that is not that
/// of anything.
[[nodiscard]] ReadObj read_glb(const std::string& path);

}  // namespace d2b::test
