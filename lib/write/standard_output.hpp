#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {

/// Redirects /vsistdout/ in the whole process: to stdout, or to another stream if drivers of GDAL print to
/// stdout.
void set_standard_output(std::FILE* output);

/// @throws OutputError always: writing to stdout failed
[[noreturn]] void refuse_lost_output();

/// Checks as far as possible in advance. @throws OutputError if `bytes` more bytes cannot be written to the
/// standard output, because it is closed, the disk is full or the reader has gone
void require_room_on_stdout(std::uint64_t bytes);

/// Captures output to /vsistdout/ during its lifetime until a CommitList publishes it.
class HeldOutput final : public PendingResult {
  public:
    HeldOutput();
    HeldOutput(const HeldOutput&) = delete;
    HeldOutput& operator=(const HeldOutput&) = delete;
    ~HeldOutput() override;

    /// @throws OutputError if there was no space for it
    void require_kept() const;

    [[nodiscard]] Kind kind() const override { return Kind::stream; }
    void check() override { require_room_on_stdout(size_); }
    void show() override;
    [[nodiscard]] std::string take_back() override { return "part of it is on stdout already"; }

  private:
    static std::size_t hold(const void* data, std::size_t size, std::size_t count, std::FILE* self);

    FileSpool spool_;
    std::uint64_t size_ = 0;
    std::exception_ptr failure_;
};

}  // namespace d2b
