#include "tiles/sealed_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <random>
#include <system_error>
#include <unistd.h>

#include "dem2buildings/version.hpp"
#include "tiles/open_file.hpp"
#include "tiles/recent_files.hpp"

namespace d2b {
namespace {

constexpr std::array<char, 8> magic{'d', '2', 'b', '-', 't', 'i', 'l', 'e'};

/// File header as stored.
struct Head {
    std::array<char, 8> magic{};
    std::array<char, 16> version{};
    std::uint64_t plan = 0;
    std::uint32_t step = 0;
    std::uint32_t part = 0;
    std::uint64_t body_size = 0;
    std::uint64_t body_digest = 0;
    std::uint64_t tail_size = 0;
};

std::array<char, 16> this_version() {
    std::array<char, 16> text{};
    std::copy_n(version.begin(), std::min(version.size(), text.size()), text.begin());
    return text;
}

Head head_of(const Seal& seal) {
    return {magic, this_version(), seal.plan, static_cast<std::uint32_t>(seal.step), seal.part, 0, 0, 0};
}

std::optional<Head> read_head(const OpenFile& file) {
    Head head;
    if (!file.is_open() || !file.read(0, std::as_writable_bytes(std::span(&head, 1))))
        return {};
    return head;
}

/// Returns true if the file has exactly the length that its header declares.
bool is_whole(const Head& head, std::uint64_t size) {
    const std::uint64_t left = size - sizeof(Head);
    return head.body_size <= left && head.tail_size == left - head.body_size;
}

std::string again(const Seal& seal) {
    const std::string step = "'" + std::string(step_name(seal.step)) + "'";
    const bool of_all = seal.step == TileStep::join || seal.step == TileStep::merge;
    return of_all ? step : step + " of tile " + std::to_string(seal.part);
}

bool is_of(const Head& head, const Seal& seal) {
    const Head wanted = head_of(seal);
    return head.magic == wanted.magic && head.version == wanted.version && head.plan == wanted.plan &&
           head.step == wanted.step && head.part == wanted.part;
}

/// Returns the difference between a file and the requested one, or "".
std::string misfit(const std::filesystem::path& path, const Head& head, const Seal& seal) {
    const Head wanted = head_of(seal);
    const std::string name = "'" + path.string() + "' ";
    const std::string instead = "; delete it and run " + again(seal) + " again.";
    if (head.magic != wanted.magic || head.step != wanted.step || head.part != wanted.part)
        return name + "is not the file that " + again(seal) + " writes" + instead;
    if (head.version != wanted.version)
        return name + "was written by another version of dem2buildings" + instead;
    if (head.plan != wanted.plan)
        return name + "belongs to another plan" + instead;
    return {};
}

std::string reason(int error) {
    return std::generic_category().message(error);
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    throw OutputError("'" + path.string() + "' cannot be written: " + reason(error) +
                      "; make room in the work folder or let it be written to, and run the step again.");
}

/// @param sync force the file to disk before it is renamed @throws OutputError
void write_file(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
                std::span<const std::byte> tail, bool sync) {
    Head head = head_of(seal);
    head.body_size = body.size();
    head.body_digest = digest_of(body);
    head.tail_size = tail.size();
    // Temporary name with a random suffix, because processes on several machines may have the same number. If
    // two processes work on one tile, their results are equal except for timings, and the last rename wins.
    const std::filesystem::path hidden =
        path.parent_path() / ("." + path.filename().string() + "." + std::to_string(::getpid()) + "." +
                              std::to_string(std::random_device()()));
    int error = 0;
    {
        const OpenFile file(hidden, O_WRONLY | O_CREAT | O_TRUNC);
        const bool done = file.is_open() && file.write(std::as_bytes(std::span(&head, 1))) &&
                          file.write(body) && file.write(tail) && (!sync || file.sync());
        error = done ? 0 : errno;
    }
    if (error == 0 && std::rename(hidden.c_str(), path.c_str()) != 0)
        error = errno;
    // Another process may have finished first and removed this file as a leftover.
    if (error == 0 || (error == ENOENT && is_sealed(path, seal)))
        return;
    ::unlink(hidden.c_str());
    fail(path, error);
}

/// @return file descriptor @throws OutputError
int open_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0)
        fail(folder, errno);
    return opened;
}

}  // namespace

std::string_view step_name(TileStep step) {
    constexpr std::array<std::string_view, 5> names{"find", "join", "draw", "merge", "write"};
    return names[static_cast<std::size_t>(step)];
}

std::uint64_t digest_of(std::span<const std::byte> bytes) {
    // FNV-1a on words of eight bytes and the remaining bytes, at about 1 GB per second.
    constexpr std::uint64_t prime = 0x100000001b3;
    std::uint64_t digest = 0xcbf29ce484222325 ^ bytes.size();
    const auto add = [&](std::uint64_t word) {
        digest = (digest ^ word) * prime;
        digest ^= digest >> 29;
    };
    for (; bytes.size() >= sizeof(std::uint64_t); bytes = bytes.subspan(sizeof(std::uint64_t))) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), sizeof(word));
        add(word);
    }
    for (const std::byte byte : bytes)
        add(static_cast<std::uint64_t>(byte));
    return digest;
}

void write_sealed(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
                  std::span<const std::byte> tail) {
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    write_file(path, seal, body, tail, true);
}

SealedFiles::SealedFiles(std::filesystem::path folder)
    : folder_(std::move(folder)), opened_(open_folder(folder_)) {}

SealedFiles::~SealedFiles() {
    ::close(opened_);
}

void SealedFiles::write(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
                        std::span<const std::byte> tail) {
    write_file(path, seal, body, tail, false);
    any_ = true;
}

void SealedFiles::finish() {
    if (any_ && ::syncfs(opened_) != 0)
        fail(folder_, errno);
}

void remove_unfinished(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with('.'))
            std::filesystem::remove(entry.path(), ignored);
}

bool is_sealed(const std::filesystem::path& path, const Seal& seal) {
    const OpenFile file(path, O_RDONLY);
    const std::optional<Head> head = read_head(file);
    return head && is_of(*head, seal) && is_whole(*head, file.size());
}

SealedFile::SealedFile(std::filesystem::path path, const Seal& seal, RecentFiles* recent)
    : path_(std::move(path)), seal_(seal), recent_(recent) {
    const std::shared_ptr<const OpenFile> opened = open();
    const OpenFile& file = *opened;
    if (!file.is_open())
        throw InputError("'" + path_.string() + "' cannot be read: " + reason(errno) + "; run " +
                         again(seal) + " first.");
    const std::optional<Head> head = read_head(file);
    if (!head)
        throw InputError(damaged("it ends too soon"));
    if (const std::string text = misfit(path_, *head, seal); !text.empty())
        throw InputError(text);
    if (!is_whole(*head, file.size()))
        throw InputError(
            damaged("it is " + std::to_string(file.size()) + " bytes long and should be of another length"));
    body_.resize(static_cast<std::size_t>(head->body_size));
    if (!file.read(sizeof(Head), body_) || digest_of(body_) != head->body_digest)
        throw InputError(damaged("its bytes are not those that were written"));
    tail_begin_ = sizeof(Head) + head->body_size;
    tail_size_ = head->tail_size;
}

std::shared_ptr<const OpenFile> SealedFile::open() const {
    return recent_ != nullptr ? recent_->open(path_) : std::make_shared<const OpenFile>(path_, O_RDONLY);
}

std::vector<std::byte> SealedFile::tail(std::uint64_t begin, std::uint64_t size) const {
    const std::shared_ptr<const OpenFile> file = open();
    if (begin > tail_size_ || size > tail_size_ - begin)
        throw InputError(damaged("more is announced than there is"));
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (!file->is_open() || !file->read(tail_begin_ + begin, bytes))
        throw InputError(damaged("it cannot be read any more"));
    return bytes;
}

std::string SealedFile::damaged(const std::string& what) const {
    return "'" + path_.string() + "' is damaged: " + what + "; delete it and run " + again(seal_) + " again.";
}

}  // namespace d2b
