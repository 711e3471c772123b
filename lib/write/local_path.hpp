#pragma once

#include <filesystem>
#include <string>

namespace d2b {

/// Resolves symbolic links and removes trailing slashes, because renaming a file onto a link would replace
/// the link.
[[nodiscard]] std::filesystem::path resolved_path(const std::string& name);

/// Checks by trial that files can be created next to a path. @param name for messages @throws OutputError if
/// the folder does not exist, is not a folder or is not writable
void check_parent_folder(const std::string& name, const std::filesystem::path& path);

}  // namespace d2b
