#pragma once

#include <optional>
#include <string>

namespace d2b {

enum class PictureFormat { png, svg, pdf };

/// Returns the format for the extension of a file name; not case-sensitive.
[[nodiscard]] std::optional<PictureFormat> picture_format_of(const std::string& name);

/// True if a file with this beginning is a picture in one of these formats.
[[nodiscard]] bool begins_a_picture(const std::string& beginning);

}  // namespace d2b
