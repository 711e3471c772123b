#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dem2buildings/commit_list.hpp"

namespace d2b {

/// A text that fits in memory, written beside its place and forced to the disk, and renamed by a CommitList:
/// it is there whole or not at all, also where several processes write it. @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_small_file(const std::filesystem::path& path,
                                                                const std::string& text);

/// One that belongs to no others. @throws OutputError
void write_small_file(const std::filesystem::path& path, const std::string& text);

}  // namespace d2b
