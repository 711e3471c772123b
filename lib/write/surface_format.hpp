#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace d2b {

/// File formats of surfaces.
enum class SurfaceFormat { cityjson, obj, stl, glb };

/// Returns the format by file extension, case-insensitive; nothing if unknown.
[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(const std::string& name);

/// True if a file is of the format, so that it may be replaced. @param beginning its first bytes
[[nodiscard]] bool begins_a_surface(SurfaceFormat format, std::string_view beginning);

/// Returns the file name of the materials of an OBJ: .mtl instead of .obj, without characters that a line of
/// an OBJ cannot hold.
[[nodiscard]] std::string materials_name(const std::string& obj);

/// True if a file holds materials of an OBJ, so that it may be replaced. @param beginning its first bytes
[[nodiscard]] bool begins_materials(std::string_view beginning);

/// Returns the end of a sentence that lists all formats: "OBJ; give "x" a name that ends in .obj".
[[nodiscard]] std::string surface_formats_advice(const std::string& name);

}  // namespace d2b
