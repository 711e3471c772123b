#include "pipeline/tiles/checkpoint_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <random>
#include <system_error>

#include "core/system/process.hpp"
#include "dem2buildings/version.hpp"
#include "pipeline/tiles/file_cache.hpp"

namespace d2b::tiles {
namespace {

constexpr std::array<char, 8> magic{'d', '2', 'b', '-', 't', 'i', 'l', 'e'};

/// File header as stored.
struct FileHeader {
    std::array<char, 8> magic{};
    std::array<char, 16> version{};
    std::uint64_t plan = 0;
    std::uint32_t step = 0;
    std::uint32_t part = 0;
    std::uint64_t body_size = 0;
    std::uint64_t body_digest = 0;
    std::uint64_t payload_size = 0;
};

std::array<char, 16> this_version() {
    std::array<char, 16> text{};
    std::copy_n(version.begin(), std::min(version.size(), text.size()), text.begin());
    return text;
}

FileHeader header_of(const Checkpoint& place) {
    return {magic, this_version(), place.plan, static_cast<std::uint32_t>(place.step), place.part, 0, 0, 0};
}

std::optional<FileHeader> read_header(const system::File& file) {
    FileHeader header;
    if (!file.is_open() || !file.read(0, std::as_writable_bytes(std::span(&header, 1))))
        return {};
    return header;
}

/// Returns true if the file has exactly the length that its header declares.
bool is_whole(const FileHeader& header, std::uint64_t size) {
    const std::uint64_t left = size - sizeof(FileHeader);
    return header.body_size <= left && header.payload_size == left - header.body_size;
}

std::string rerun_text(const Checkpoint& place) {
    const std::string step = "'" + std::string(step_name(place.step)) + "'";
    const bool of_all =
        place.step == TileStep::join || place.step == TileStep::merge || place.step == TileStep::plan;
    return of_all ? step : step + " of tile " + std::to_string(place.part);
}

bool is_of(const FileHeader& header, const Checkpoint& place) {
    const FileHeader wanted = header_of(place);
    return header.magic == wanted.magic && header.version == wanted.version && header.plan == wanted.plan &&
           header.step == wanted.step && header.part == wanted.part;
}

/// Returns the difference between a file and the requested one, or "".
std::string mismatch(const FileHeader& header, const Checkpoint& place) {
    const FileHeader wanted = header_of(place);
    const std::string name = "'" + place.path.string() + "' ";
    const std::string instead = "; delete it and run " + rerun_text(place) + " again.";
    if (header.magic != wanted.magic || header.step != wanted.step || header.part != wanted.part)
        return name + "is not the file that " + rerun_text(place) + " writes" + instead;
    if (header.version != wanted.version)
        return name + "was written by another version of dem2buildings" + instead;
    if (header.plan != wanted.plan)
        return name + "belongs to another plan" + instead;
    return {};
}

std::string reason(int error) {
    return std::generic_category().message(error);
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    throw OutputError("'" + path.string() + "' cannot be written: " + reason(error) +
                      "; free some space in the work folder or allow writing to it, and run the step again.");
}

/// @param sync force the file to disk before it is renamed @throws OutputError
void write_file(const Checkpoint& place, std::span<const std::byte> body, std::span<const std::byte> payload,
                bool sync) {
    const std::filesystem::path& path = place.path;
    FileHeader header = header_of(place);
    header.body_size = body.size();
    header.body_digest = digest_of(body);
    header.payload_size = payload.size();
    // Temporary name with a random suffix, because processes on several machines may have the same number. If
    // two processes work on one tile, their results are equal except for timings, and the last rename wins.
    const std::filesystem::path temporary =
        path.parent_path() / ("." + path.filename().string() + "." + std::to_string(system::process_id()) +
                              "." + std::to_string(std::random_device()()));
    int error = 0;
    {
        const system::File file(temporary, system::File::Mode::write);
        const bool done = file.is_open() && file.write(std::as_bytes(std::span(&header, 1))) &&
                          file.write(body) && file.write(payload) && (!sync || file.sync());
        error = done ? 0 : errno;
    }
    if (error == 0)
        error = system::replace(temporary, path);
    // Another process may have finished first and removed this file as a leftover.
    if (error == 0 || (error == ENOENT && checkpoint_exists(place)))
        return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    fail(path, error);
}

/// Creates a folder if there is none.
std::filesystem::path made_folder(std::filesystem::path folder) {
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    return folder;
}

}  // namespace

std::string_view step_name(TileStep step) {
    constexpr std::array<std::string_view, 6> names{"find", "join", "draw", "merge", "write", "plan"};
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

void write_checkpoint(const Checkpoint& place, std::span<const std::byte> body,
                      std::span<const std::byte> payload) {
    std::error_code ignored;
    std::filesystem::create_directories(place.path.parent_path(), ignored);
    write_file(place, body, payload, true);
}

CheckpointBatch::CheckpointBatch(std::filesystem::path folder)
    : folder_(made_folder(std::move(folder))), opened_(folder_) {
    if (!opened_.is_open())
        fail(folder_, errno);
}

void CheckpointBatch::write(const Checkpoint& place, std::span<const std::byte> body,
                            std::span<const std::byte> payload) {
    write_file(place, body, payload, system::OpenFolder::needs_sync_of_each_file());
    any_ = true;
}

void CheckpointBatch::finish() {
    if (any_ && !opened_.sync_file_system())
        fail(folder_, errno);
}

void remove_unfinished(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with('.'))
            std::filesystem::remove(entry.path(), ignored);
}

bool checkpoint_exists(const Checkpoint& place) {
    const system::File file(place.path, system::File::Mode::read);
    const std::optional<FileHeader> header = read_header(file);
    return header && is_of(*header, place) && is_whole(*header, file.size());
}

CheckpointFile::CheckpointFile(Checkpoint place, FileHandleCache* cache)
    : place_(std::move(place)), cache_(cache) {
    const std::shared_ptr<const system::File> opened = open();
    const system::File& file = *opened;
    if (!file.is_open())
        throw InputError("'" + place_.path.string() + "' cannot be read: " + reason(errno) + "; run " +
                         rerun_text(place_) + " first.");
    const std::optional<FileHeader> header = read_header(file);
    if (!header)
        throw InputError(damaged("it is truncated"));
    if (const std::string text = mismatch(*header, place_); !text.empty())
        throw InputError(text);
    if (!is_whole(*header, file.size()))
        throw InputError(
            damaged("it is " + std::to_string(file.size()) + " bytes long and should be of another length"));
    body_.resize(static_cast<std::size_t>(header->body_size));
    if (!file.read(sizeof(FileHeader), body_) || digest_of(body_) != header->body_digest)
        throw InputError(damaged("its bytes have changed since it was written"));
    payload_begin_ = sizeof(FileHeader) + header->body_size;
    payload_size_ = header->payload_size;
}

std::shared_ptr<const system::File> CheckpointFile::open() const {
    return cache_ != nullptr ? cache_->open(place_.path)
                             : std::make_shared<const system::File>(place_.path, system::File::Mode::read);
}

std::vector<std::byte> CheckpointFile::payload(std::uint64_t begin, std::uint64_t size) const {
    const std::shared_ptr<const system::File> file = open();
    if (begin > payload_size_ || size > payload_size_ - begin)
        throw InputError(damaged("it holds less than it announces"));
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (!file->is_open() || !file->read(payload_begin_ + begin, bytes))
        throw InputError(damaged("it cannot be read any more"));
    return bytes;
}

std::string CheckpointFile::damaged(const std::string& what) const {
    return "'" + place_.path.string() + "' is damaged: " + what + "; delete it and run " +
           rerun_text(place_) + " again.";
}

void PayloadBlocks::add(const ByteWriter& block) {
    if (block.bytes().empty())
        return;
    blocks_.push_back({block.bytes().size(), digest_of(block.bytes())});
    bytes_.insert(bytes_.end(), block.bytes().begin(), block.bytes().end());
}

ByteReader read_block(const CheckpointFile& file, std::uint64_t begin, const PayloadBlocks::Block& block) {
    std::vector<std::byte> bytes = file.payload(begin, block.size);
    if (digest_of(bytes) != block.digest)
        throw InputError(file.damaged("its bytes have changed since it was written"));
    return ByteReader(std::move(bytes));
}

}  // namespace d2b::tiles
