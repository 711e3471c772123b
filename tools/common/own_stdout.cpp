#include "common/own_stdout.hpp"

#include <iostream>

#include "common/run_guarded.hpp"
#include "core/system/streams.hpp"

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

OwnStdout::OwnStdout() {
    std::cout.flush();
    static_cast<void>(std::fflush(stdout));
    file_.reset(system::divert_stdout());
    if (!file_)
        return;
    buffer_ = std::make_unique<Buffer>(file_.get());
    before_ = std::cout.rdbuf(buffer_.get());
    writing::set_standard_output(file_.get());
}

OwnStdout::~OwnStdout() {
    if (!buffer_)
        return;
    std::cout.rdbuf(before_);
    writing::set_standard_output(stdout);
    static_cast<void>(std::fflush(stdout));
    system::restore_stdout(file_.get());
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
