// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iterator>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/read_city.hpp"

namespace d2b::mesh {

CityModel read_city(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file || file.bad())
        throw InputError("'" + path + "' cannot be read; check its name and rights.");
    return parse_city(text, path);
}

}  // namespace d2b::mesh
