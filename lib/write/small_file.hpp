#pragma once

#include <filesystem>
#include <string>

namespace d2b {

/// Writes a text that fits in memory beside its place, forces it to the disk and renames it: it is there
/// whole or not at all, also where several processes write it. @throws OutputError
void write_small_file(const std::filesystem::path& path, const std::string& text);

}  // namespace d2b
