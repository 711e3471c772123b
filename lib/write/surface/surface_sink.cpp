#include "write/surface/surface_sink.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "core/text.hpp"
#include "write/surface/cityjson_sink.hpp"
#include "write/surface/glb_sink.hpp"
#include "write/surface/obj_stl_sink.hpp"

namespace d2b::writing {
namespace {

/// True if the first word of the text is in the list; skips comments and empty lines.
bool first_word_is_one_of(std::string_view text, std::span<const std::string_view> words) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
        if (!word.empty() && !word.starts_with('#'))
            return std::ranges::find(words, word) != words.end();
    }
    return true;  // comments only
}

bool looks_like_obj(std::string_view text) {
    constexpr std::array<std::string_view, 9> words{"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"};
    return first_word_is_one_of(text, words);
}

/// Searches for the type only, because it is usually the first member.
bool looks_like_cityjson(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{' &&
           text.find("\"CityJSON\"") != std::string_view::npos;
}

/// Detects ASCII only, because a binary STL begins with 80 arbitrary bytes.
bool looks_like_stl(std::string_view text) {
    return text.starts_with("solid");
}

bool looks_like_glb(std::string_view text) {
    return text.starts_with("glTF");
}

struct SurfaceFormatEntry {
    SurfaceFormat format;
    std::string_view name;
    std::string_view ending;
    bool (*begins)(std::string_view);
};

constexpr std::array surface_format_entries{
    SurfaceFormatEntry{SurfaceFormat::cityjson, "CityJSON", ".city.json", looks_like_cityjson},
    SurfaceFormatEntry{SurfaceFormat::obj, "OBJ", ".obj", looks_like_obj},
    SurfaceFormatEntry{SurfaceFormat::stl, "STL", ".stl", looks_like_stl},
    SurfaceFormatEntry{SurfaceFormat::glb, "glTF", ".glb", looks_like_glb}};

}  // namespace

std::optional<SurfaceFormat> surface_format_of(const std::string& name) {
    const std::string lower = to_lower(name);
    for (const SurfaceFormatEntry& row : surface_format_entries)
        if (lower.ends_with(row.ending))
            return row.format;
    return std::nullopt;
}

bool looks_like_surface(SurfaceFormat format, std::string_view beginning) {
    return std::ranges::find(surface_format_entries, format, &SurfaceFormatEntry::format)->begins(beginning);
}

std::string mtl_name(const std::string& obj) {
    const std::size_t base = obj.find_last_of('/') + 1;  // 0 without a folder
    std::string name = obj.substr(0, obj.size() - std::string_view(".obj").size()) + ".mtl";
    for (std::size_t i = base; i < name.size(); ++i)
        if (static_cast<unsigned char>(name[i]) < ' ' || name[i] == '\\')
            name[i] = '_';
    return name;
}

bool looks_like_mtl(std::string_view beginning) {
    constexpr std::array<std::string_view, 1> words{"newmtl"};
    return first_word_is_one_of(beginning, words);
}

std::string surface_formats_advice(const std::string& name) {
    std::string names;
    std::string endings;
    for (const SurfaceFormatEntry& row : surface_format_entries) {
        const char* between = names.empty()                                        ? ""
                              : row.format == surface_format_entries.back().format ? " or "
                                                                                   : ", ";
        names += between + std::string(row.name);
        endings += between + std::string(row.ending);
    }
    const std::string lower = to_lower(name);
    if (lower.ends_with(".gml") || lower.ends_with(".citygml"))
        return names + "; for CityGML write a .city.json, and convert it with citygml-tools from-cityjson";
    return names + "; give \"" + name + "\" a name that ends in " + endings;
}

SurfaceDestination resolve_surface_target(const FileTarget& target) {
    SurfaceDestination place{resolve_file_target(target), std::nullopt};
    if (surface_format_of(target.destination) == SurfaceFormat::obj) {
        FileTarget materials = target;
        materials.destination = mtl_name(target.destination);
        materials.format = FileKind::materials;
        place.materials = resolve_file_target(materials);
    }
    return place;
}

std::unique_ptr<SurfaceSink> open_surface_sink(SurfaceDestination place, SurfaceSolids solids) {
    switch (*surface_format_of(place.file.name)) {
        case SurfaceFormat::cityjson:
            return open_cityjson_sink(std::move(place.file));
        case SurfaceFormat::glb:
            return open_glb_sink(std::move(place.file));
        case SurfaceFormat::stl:
            return open_stl_sink(std::move(place.file), solids);
        case SurfaceFormat::obj:
            break;
    }
    return open_obj_sink(std::move(place.file), std::move(*place.materials), solids);
}

}  // namespace d2b::writing
