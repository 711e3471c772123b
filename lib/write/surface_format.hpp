#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace d2b {

/// Formats of surfaces.
enum class SurfaceFormat { cityjson, obj, stl, glb };

/// By the end of a file's name, in letters of either case; nothing where it is none of theirs.
[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(const std::string& name);

/// Whether a file may be replaced by one of a format, since it is one. @param beginning its first bytes
[[nodiscard]] bool begins_a_surface(SurfaceFormat format, std::string_view beginning);

/// The name of the materials of an OBJ: its own with .mtl in place of .obj, without what a line of an OBJ
/// cannot hold.
[[nodiscard]] std::string materials_name(const std::string& obj);

/// Whether a file may be replaced by materials of an OBJ, since it has some. @param beginning its first bytes
[[nodiscard]] bool begins_materials(std::string_view beginning);

/// "OBJ; give "x" a name that ends in .obj", with all formats: ends a sentence.
[[nodiscard]] std::string surface_formats_advice(const std::string& name);

}  // namespace d2b
