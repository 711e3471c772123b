#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dem2buildings/commit_list.hpp"

namespace d2b {

/// Writes a text to a temporary file next to its destination and syncs it; a CommitList renames it. The file
/// appears whole or not at all, even if several processes write it. @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_small_file(const std::filesystem::path& path,
                                                                const std::string& text);

/// Same, but publishes at once. @throws OutputError
void write_small_file(const std::filesystem::path& path, const std::string& text);

}  // namespace d2b
