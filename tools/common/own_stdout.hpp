#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <streambuf>
#include <string>

#include "core/system/process.hpp"
#include "dem2buildings/commit_list.hpp"
#include "write/standard_output.hpp"

namespace d2b {

/// Keeps the standard output for the tool's own text, through std::cout and /vsistdout/: while it
/// lives, text of libraries to stdout goes to stderr, and a reader that goes away is an error of writing
/// instead of the end of the process. Without a standard output libraries print where they did.
class OwnStdout {
  public:
    OwnStdout();
    OwnStdout(const OwnStdout&) = delete;
    OwnStdout& operator=(const OwnStdout&) = delete;
    ~OwnStdout();

    /// Finishes a result. @throws OutputError if not all has been written
    void finish();
    /// Finishes a text beside a result, which stays valid: warns if not all has been written.
    void finish_aside();

    /// A report that is the result, or a part of it: nothing shows of a run whose report is lost. @param text
    /// makes it
    template <typename Report>
    [[nodiscard]] ReportReader<Report> reader(std::function<std::string(const Report&)> text) {
        return {[text](const Report& report) { writing::require_stdout_space(text(report).size()); },
                [this, text](const Report& report) { print(text(report)); }};
    }

  private:
    void print(const std::string& text);
    [[nodiscard]] bool is_written();

    class Buffer;
    struct Close {
        void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
    };
    system::IgnoreBrokenPipe ignore_broken_pipe_;
    std::unique_ptr<std::FILE, Close> file_;  // the standard output as it was
    std::unique_ptr<Buffer> buffer_;
    std::streambuf* before_ = nullptr;  // of std::cout
};

}  // namespace d2b
