#include "common/own_stdout.hpp"

#include <csignal>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

#include "common/run_guarded.hpp"

namespace d2b {

/// Hands on to a stream of C.
class OwnStdout::Buffer : public std::streambuf {
  public:
    explicit Buffer(std::FILE* file) : file_(file) {}

  protected:
    int_type overflow(int_type letter) override {
        if (traits_type::eq_int_type(letter, traits_type::eof()))
            return traits_type::not_eof(letter);
        return std::fputc(letter, file_) == EOF ? traits_type::eof() : letter;
    }
    std::streamsize xsputn(const char* text, std::streamsize count) override {
        return static_cast<std::streamsize>(std::fwrite(text, 1, static_cast<std::size_t>(count), file_));
    }
    int sync() override { return std::fflush(file_) == 0 ? 0 : -1; }

  private:
    std::FILE* file_;
};

OwnStdout::OwnStdout() : on_broken_pipe_(std::signal(SIGPIPE, SIG_IGN)) {
    std::cout.flush();
    static_cast<void>(std::fflush(stdout));
    const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (copy < 0)
        return;
    file_.reset(fdopen(copy, "w"));
    if (!file_ || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        file_.reset();
        return;
    }
    buffer_ = std::make_unique<Buffer>(file_.get());
    before_ = std::cout.rdbuf(buffer_.get());
    writing::set_standard_output(file_.get());
}

OwnStdout::~OwnStdout() {
    static_cast<void>(std::signal(SIGPIPE, on_broken_pipe_));
    if (!buffer_)
        return;
    std::cout.rdbuf(before_);
    writing::set_standard_output(stdout);
    static_cast<void>(std::fflush(stdout));
    static_cast<void>(dup2(fileno(file_.get()), STDOUT_FILENO));
}

bool OwnStdout::is_written() {
    return std::cout.flush() && std::ferror(file_ ? file_.get() : stdout) == 0;
}

void OwnStdout::finish() {
    if (!is_written())
        writing::throw_stdout_failure();
}

void OwnStdout::finish_aside() {
    if (is_written())
        return;
    print_line("Warning: ", "The summary could not be written to stdout; the result is whole.");
    // It has been told of.
    std::cout.clear();
    std::clearerr(stdout);
}

void OwnStdout::print(const std::string& text) {
    std::cout << text;
    finish();
}

}  // namespace d2b
