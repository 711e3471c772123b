#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b::writing {

/// Redirects /vsistdout/ in the whole process: to stdout, or to another stream if drivers of GDAL print to
/// stdout.
void set_standard_output(std::FILE* output);

/// @throws OutputError always: writing to stdout failed
[[noreturn]] void throw_stdout_failure();

/// Checks as far as possible in advance. @throws OutputError if `bytes` more bytes cannot be written to the
/// standard output, because it is closed, the disk is full or the reader has gone
void require_stdout_space(std::uint64_t bytes);

/// Captures output to /vsistdout/ during its lifetime until a CommitList publishes it.
class CapturedOutput final : public PendingResult {
  public:
    /// @param pipe named pipe or device that gets the output; "" for stdout. Drivers do not write to it
    /// themselves, because some take it for an existing file.
    explicit CapturedOutput(std::string pipe = "");
    CapturedOutput(const CapturedOutput&) = delete;
    CapturedOutput& operator=(const CapturedOutput&) = delete;
    ~CapturedOutput() override;

    /// @throws OutputError if there was no space for it
    void require_captured() const;

    [[nodiscard]] Kind kind() const override { return Kind::stream; }
    void check() override;
    void show() override;
    [[nodiscard]] std::string roll_back() override;

  private:
    /// @return false if it cannot be written
    [[nodiscard]] bool write_to(std::FILE* output) const;
    static std::size_t capture(const void* data, std::size_t size, std::size_t count, std::FILE* self);

    std::string pipe_;
    FileSpool spool_;
    std::uint64_t size_ = 0;
    std::exception_ptr failure_;
};

}  // namespace d2b::writing
