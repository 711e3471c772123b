#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {

/// Where /vsistdout/ writes to from now on, in the whole process: stdout, or another stream, which leaves
/// stdout to what GDAL's drivers print.
void set_standard_output(std::FILE* output);

/// @throws OutputError: not all that was written to stdout is there
[[noreturn]] void refuse_lost_output();

/// As far as can be known before it is tried. @throws OutputError where so many bytes more would not get
/// through to the standard output, since it is closed, the disk is full or the reader has gone
void require_room_on_stdout(std::uint64_t bytes);

/// Keeps what is written to /vsistdout/ while it lives, until a CommitList shows it.
class HeldOutput final : public PendingResult {
  public:
    HeldOutput();
    HeldOutput(const HeldOutput&) = delete;
    HeldOutput& operator=(const HeldOutput&) = delete;
    ~HeldOutput() override;

    /// @throws OutputError where there was no room to keep it
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
