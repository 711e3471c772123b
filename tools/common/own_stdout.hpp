#pragma once

#include <cstdio>
#include <memory>
#include <streambuf>

namespace d2b {

/// Keeps the standard output for what the tool itself writes, through std::cout and /vsistdout/: while it
/// lives, what libraries print to stdout goes to stderr. Without a standard output nothing changes.
class OwnStdout {
  public:
    OwnStdout();
    OwnStdout(const OwnStdout&) = delete;
    OwnStdout& operator=(const OwnStdout&) = delete;
    ~OwnStdout();

    /// @throws OutputError where not all has been written
    void finish();

  private:
    class Buffer;
    struct Close {
        void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
    };
    std::unique_ptr<std::FILE, Close> file_;  // the standard output as it was
    std::unique_ptr<Buffer> buffer_;
    std::streambuf* before_ = nullptr;  // of std::cout
};

}  // namespace d2b
