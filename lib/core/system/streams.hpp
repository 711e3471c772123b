#pragma once

#include <cstdint>
#include <cstdio>

namespace d2b::system {

/// Gives standard streams that are closed something that fails, because files opened later would take their
/// numbers, and output would end up in them. Lets all of them pass bytes unchanged, and text be UTF-8.
void prepare_streams();

/// Both stdout and stderr.
[[nodiscard]] bool are_terminals();

/// Redirects stdout to stderr from now on. @return a copy of stdout, or null if there
/// is no stdout
[[nodiscard]] std::FILE* divert_stdout();
/// Undoes this.
void restore_stdout(std::FILE* copy);

/// Checks as far as possible in advance. @return false if `bytes` more bytes cannot be written, because the
/// stream is closed, the disk is full or the reader has gone
[[nodiscard]] bool has_space(std::FILE* stream, std::uint64_t bytes);

}  // namespace d2b::system
