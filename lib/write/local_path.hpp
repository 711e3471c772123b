#pragma once

#include <filesystem>
#include <string>

namespace d2b {

/// The path without symbolic links at its end and without slashes there: a renamed file must not replace the
/// link that leads to it.
[[nodiscard]] std::filesystem::path resolved_path(const std::string& name);

/// Tries whether files can be made beside a path. @param name for messages
/// @throws OutputError: no such folder, not a folder, not writable
void check_parent_folder(const std::string& name, const std::filesystem::path& path);

}  // namespace d2b
