#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// File formats of surfaces.
enum class SurfaceFormat { cityjson, obj, stl, glb };

/// Returns the format by file extension, case-insensitive; nothing if unknown.
[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(const std::string& name);

/// True if a file is of the format, so that it may be replaced. @param beginning its first bytes
[[nodiscard]] bool looks_like_surface(SurfaceFormat format, std::string_view beginning);

/// Returns the file name of the materials of an OBJ: .mtl instead of .obj, without characters that a line of
/// an OBJ cannot hold.
[[nodiscard]] std::string mtl_name(const std::string& obj);

/// True if a file holds materials of an OBJ, so that it may be replaced. @param beginning its first bytes
[[nodiscard]] bool looks_like_mtl(std::string_view beginning);

/// Returns the end of a sentence that lists all formats: "OBJ; give "x" a name that ends in .obj".
[[nodiscard]] std::string surface_formats_advice(const std::string& name);

/// Destination files of a surface.
struct SurfaceDestination {
    FileDestination file;
    std::optional<FileDestination> materials;  ///< second file of an OBJ
};

/// @param target of FileKind::surface @throws OptionError, OutputError like resolve_file_target()
[[nodiscard]] SurfaceDestination resolve_surface_target(const FileTarget& target);

/// Opens a surface in the format of the file extension. @param solids used by OBJ and STL
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(SurfaceDestination place, SurfaceSolids solids);

}  // namespace d2b::writing
