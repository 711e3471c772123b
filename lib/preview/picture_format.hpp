#pragma once

#include <optional>
#include <string>

namespace d2b {

enum class PictureFormat { png, svg, pdf };

/// The format that the extension of a file's name stands for, in letters of either case.
[[nodiscard]] std::optional<PictureFormat> picture_format_of(const std::string& name);

/// Whether a file that begins like this is a picture of one of these formats.
[[nodiscard]] bool begins_a_picture(const std::string& beginning);

}  // namespace d2b
