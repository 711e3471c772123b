#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>

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
    CapturedOutput();
    CapturedOutput(const CapturedOutput&) = delete;
    CapturedOutput& operator=(const CapturedOutput&) = delete;
    ~CapturedOutput() override;

    /// @throws OutputError if there was no space for it
    void require_captured() const;

    [[nodiscard]] Kind kind() const override { return Kind::stream; }
    void check() override { require_stdout_space(size_); }
    void show() override;
    [[nodiscard]] std::string roll_back() override { return "part of it is on stdout already"; }

  private:
    static std::size_t capture(const void* data, std::size_t size, std::size_t count, std::FILE* self);

    FileSpool spool_;
    std::uint64_t size_ = 0;
    std::exception_ptr failure_;
};

}  // namespace d2b::writing
