// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/mesh_text.hpp"

namespace d2b::mesh {
namespace {

struct MeshFormat {
    std::string_view ending;
    bool local = true;
    void (*write)(const NamedShell&, const TextSink&);
};

constexpr std::array formats{MeshFormat{".stl", true, write_stl}, MeshFormat{".obj", true, write_obj},
                             MeshFormat{".city.json", false, write_city_json}};

const MeshFormat* format_of(std::string name) {
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::ranges::find_if(
        formats, [&](const MeshFormat& format) { return name.ends_with(format.ending); });
    return found == formats.end() ? nullptr : found;
}

}  // namespace

writing::FileDestination locate_mesh(const MeshRequest& request) {
    if (format_of(request.destination) == nullptr)
        throw OptionError("Meshes are written as STL, OBJ and CityJSON; give '" + request.destination +
                          "' a name that ends in .stl, .obj or .city.json.");
    return writing::resolve_file_target(
        {request.destination, request.overwrite, {request.city, request.ground}, writing::FileKind::surface});
}

bool is_local(const std::string& destination) {
    return format_of(destination)->local;
}

void write_mesh(const NamedShell& shell, const std::string& destination, writing::FileWriter& file) {
    format_of(destination)->write(shell, [&](const std::string& text) { file.write(text); });
}

}  // namespace d2b::mesh
