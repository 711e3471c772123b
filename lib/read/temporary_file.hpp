#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/system/file.hpp"

namespace d2b::reading {

/// Decides if other processes can open a file. An unnamed file vanishes with the process, however that ends.
using FileName = system::File::Name;

/// Exclusively created file, removed by the destructor. Errors are OutputErrors that name the data, the
/// reason and a remedy.
class TemporaryFile {
  public:
    /// @param folder "": configuration option CPL_TMPDIR, or the system's
    /// @param what data it holds, for messages: "The standard input" @throws OutputError
    TemporaryFile(const std::string& folder, std::string what, FileName name);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    /// @throws OutputError if there is no room
    void append(std::span<const std::byte> bytes);
    /// Reads appended bytes. Thread-safe. @throws OutputError
    void read(std::uint64_t begin, std::span<std::byte> bytes) const;
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// "" for an unnamed file.
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    [[noreturn]] void fail(int error) const;

    std::string folder_;
    std::string what_;
    std::string path_;
    std::optional<system::File> file_;  ///< empty after the destructor
    std::uint64_t size_ = 0;
};

/// Returns true if a source is standard input, which can be read only once and only forwards.
[[nodiscard]] bool is_standard_input(std::string_view source);

/// Copies the source to a temporary file if it is standard input; returns null otherwise.
/// @throws InputError nothing came in. @throws OutputError the temporary file cannot be written
[[nodiscard]] std::unique_ptr<TemporaryFile> copy_standard_input(const std::string& source);

}  // namespace d2b::reading
