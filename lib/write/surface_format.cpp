#include "write/surface_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <span>

namespace d2b {
namespace {

/// True if the first word of the text is in the list; skips comments and empty lines.
bool begins_with_word(std::string_view text, std::span<const std::string_view> words) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
        if (!word.empty() && !word.starts_with('#'))
            return std::ranges::find(words, word) != words.end();
    }
    return true;  // comments only
}

bool begins_an_obj(std::string_view text) {
    constexpr std::array<std::string_view, 9> words{"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"};
    return begins_with_word(text, words);
}

/// Searches for the type only, because it is usually the first member.
bool begins_a_cityjson(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{' &&
           text.find("\"CityJSON\"") != std::string_view::npos;
}

/// Detects ASCII only, because a binary STL begins with 80 arbitrary bytes.
bool begins_an_stl(std::string_view text) {
    return text.starts_with("solid");
}

bool begins_a_glb(std::string_view text) {
    return text.starts_with("glTF");
}

struct SurfaceRow {
    SurfaceFormat format;
    std::string_view name;
    std::string_view ending;
    bool (*begins)(std::string_view);
};

constexpr std::array surface_rows{
    SurfaceRow{SurfaceFormat::cityjson, "CityJSON", ".city.json", begins_a_cityjson},
    SurfaceRow{SurfaceFormat::obj, "OBJ", ".obj", begins_an_obj},
    SurfaceRow{SurfaceFormat::stl, "STL", ".stl", begins_an_stl},
    SurfaceRow{SurfaceFormat::glb, "glTF", ".glb", begins_a_glb}};

}  // namespace

std::optional<SurfaceFormat> surface_format_of(const std::string& name) {
    std::string lower = name;
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const SurfaceRow& row : surface_rows)
        if (lower.ends_with(row.ending))
            return row.format;
    return std::nullopt;
}

bool begins_a_surface(SurfaceFormat format, std::string_view beginning) {
    return std::ranges::find(surface_rows, format, &SurfaceRow::format)->begins(beginning);
}

std::string materials_name(const std::string& obj) {
    const std::size_t base = obj.find_last_of('/') + 1;  // 0 without a folder
    std::string name = obj.substr(0, obj.size() - std::string_view(".obj").size()) + ".mtl";
    for (std::size_t i = base; i < name.size(); ++i)
        if (static_cast<unsigned char>(name[i]) < ' ' || name[i] == '\\')
            name[i] = '_';
    return name;
}

bool begins_materials(std::string_view beginning) {
    constexpr std::array<std::string_view, 1> words{"newmtl"};
    return begins_with_word(beginning, words);
}

std::string surface_formats_advice(const std::string& name) {
    std::string names;
    std::string endings;
    for (const SurfaceRow& row : surface_rows) {
        const char* between = names.empty() ? "" : row.format == surface_rows.back().format ? " or " : ", ";
        names += between + std::string(row.name);
        endings += between + std::string(row.ending);
    }
    return names + "; give \"" + name + "\" a name that ends in " + endings;
}

}  // namespace d2b
