#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "cli/read_obj.hpp"

namespace d2b::test {
namespace {

/// Numbers with a point, whatever the locale says.
std::istringstream line_of(std::ifstream& file) {
    std::string line;
    std::getline(file, line);
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    return words;
}

ReadObj::Corner three_after(const std::string& expected, std::ifstream& file) {
    std::istringstream words = line_of(file);
    std::string word;
    ReadObj::Corner corner{};
    words >> word >> corner[0] >> corner[1] >> corner[2];
    EXPECT_TRUE(words) << expected;
    EXPECT_EQ(word, expected);
    return corner;
}

void expect_line(const std::string& expected, std::ifstream& file) {
    EXPECT_EQ(line_of(file).str(), expected);
}

void expect_normal(const ReadObj::Triangle& t, const ReadObj::Corner& normal) {
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = static_cast<double>(t[1][i]) - static_cast<double>(t[0][i]);
        v[i] = static_cast<double>(t[2][i]) - static_cast<double>(t[0][i]);
    }
    const std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                  u[0] * v[1] - u[1] * v[0]};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(n[i] / std::hypot(n[0], n[1], n[2]), static_cast<double>(normal[i]), 0.01);
}

}  // namespace

ReadObj read_stl(const std::string& path) {
    ReadObj stl;
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::string name;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "solid") {
            words >> name;
            stl.comments.push_back(line);
        } else if (word == "facet") {
            words.imbue(std::locale::classic());
            ReadObj::Corner normal{};
            words >> word >> normal[0] >> normal[1] >> normal[2];
            EXPECT_EQ(word, "normal");
            expect_line("outer loop", file);
            ReadObj::Triangle triangle;
            for (ReadObj::Corner& corner : triangle)
                corner = three_after("vertex", file);
            expect_line("endloop", file);
            expect_line("endfacet", file);
            expect_normal(triangle, normal);
            stl.groups[name].push_back(triangle);
        } else {
            EXPECT_EQ(line, "endsolid " + name);
        }
    }
    return stl;
}

}  // namespace d2b::test
