#include "write/standard_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <cpl_vsi.h>

#include "core/system/streams.hpp"
#include "dem2buildings/error.hpp"

namespace d2b::writing {
namespace {

std::FILE*& stream() {
    // Global because /vsistdout/ of GDAL is global too, and GDAL has no getter for its target.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
    static std::FILE* chosen = stdout;
    return chosen;
}

}  // namespace

void set_standard_output(std::FILE* output) {
    stream() = output;
    VSIStdoutSetRedirection(std::fwrite, output);
}

void throw_stdout_failure() {
    throw OutputError("Cannot write to stdout; check whether the disk is full or the reader has gone.");
}

void require_stdout_space(std::uint64_t bytes) {
    if (bytes > 0 &&
        (std::ferror(stream()) != 0 || std::fflush(stream()) != 0 || !system::has_space(stream(), bytes)))
        throw_stdout_failure();
}

CapturedOutput::CapturedOutput(std::string pipe) : pipe_(std::move(pipe)) {
    // GDAL only passes the stream through, so it can carry a pointer to this object.
    VSIStdoutSetRedirection(capture, reinterpret_cast<std::FILE*>(this));
}

CapturedOutput::~CapturedOutput() {
    VSIStdoutSetRedirection(std::fwrite, stream());
}

std::size_t CapturedOutput::capture(const void* data, std::size_t size, std::size_t count, std::FILE* self) {
    CapturedOutput& held = *reinterpret_cast<CapturedOutput*>(self);
    try {
        held.spool_.append({static_cast<const std::byte*>(data), size * count});
        held.size_ += size * count;
        return count;
    } catch (...) {  // exceptions must not pass through GDAL
        held.failure_ = std::current_exception();
        return 0;
    }
}

void CapturedOutput::require_captured() const {
    if (failure_)
        std::rethrow_exception(failure_);
}

void CapturedOutput::check() {
    if (pipe_.empty())
        require_stdout_space(size_);
}

bool CapturedOutput::write_to(std::FILE* output) const {
    constexpr std::uint64_t most = std::uint64_t{1} << 20;
    std::vector<std::byte> bytes;
    for (std::uint64_t at = 0; at < size_; at += bytes.size()) {
        bytes.resize(static_cast<std::size_t>(std::min(most, size_ - at)));
        spool_.read(at, bytes);
        if (std::fwrite(bytes.data(), 1, bytes.size(), output) != bytes.size())
            return false;
    }
    return std::fflush(output) == 0;
}

void CapturedOutput::show() {
    if (pipe_.empty()) {
        if (!write_to(stream()))
            throw_stdout_failure();
        return;
    }
    const auto close = [](std::FILE* file) { static_cast<void>(std::fclose(file)); };
    const std::unique_ptr<std::FILE, decltype(close)> output(std::fopen(pipe_.c_str(), "wb"), close);
    if (!output || !write_to(output.get()))
        throw OutputError("Cannot write \"" + pipe_ + "\": " + std::generic_category().message(errno) + ".");
}

std::string CapturedOutput::roll_back() {
    return pipe_.empty() ? "part of it is on stdout already" : "part of it is in \"" + pipe_ + "\" already";
}

}  // namespace d2b::writing
