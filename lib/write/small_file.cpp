#include "write/small_file.hpp"

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/file_moves.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

class PendingSmallFile final : public PendingResult {
  public:
    PendingSmallFile(fs::path path, const std::string& text);
    ~PendingSmallFile() override;

    [[nodiscard]] Kind kind() const override { return Kind::file; }
    void show() override;
    [[nodiscard]] std::string take_back() override;
    void keep() override { moves_.keep(); }

  private:
    [[noreturn]] void fail(const std::system_error& error) const;
    [[nodiscard]] fs::path spare() const { return hidden_.string() + ".old"; }

    fs::path path_;
    fs::path hidden_;
    FileMoves moves_;
};

PendingSmallFile::PendingSmallFile(fs::path path, const std::string& text)
    : path_(std::move(path)),
      // Process ids may coincide between machines, so append a random number.
      hidden_(path_.parent_path() / ("." + path_.filename().string() + "." + std::to_string(::getpid()) +
                                     "." + std::to_string(std::random_device()()))) {
    try {
        {
            std::ofstream file(hidden_, std::ios::binary);
            file << text;
            file.flush();
            if (!file)
                throw std::system_error(errno, std::generic_category());
        }
        sync_to_disk(hidden_);
    } catch (const std::system_error& error) {
        std::error_code ignored;
        fs::remove(hidden_, ignored);
        fail(error);
    }
}

PendingSmallFile::~PendingSmallFile() {
    moves_.keep();
    std::error_code ignored;
    fs::remove(hidden_, ignored);
    fs::remove(spare(), ignored);
}

void PendingSmallFile::fail(const std::system_error& error) const {
    throw OutputError("\"" + path_.string() + "\" cannot be written: " + error.code().message() +
                      "; make room for it, or let it be written to.");
}

void PendingSmallFile::show() {
    try {
        try {
            moves_.move(hidden_, path_);
        } catch (const std::system_error& error) {
            if (error.code().value() != EEXIST)
                throw;
            moves_.replace(hidden_, path_, spare());
        }
    } catch (const std::system_error& error) {
        fail(error);
    }
}

std::string PendingSmallFile::take_back() {
    return moves_.take_back().empty() ? "" : "\"" + path_.string() + "\" has been written already";
}

}  // namespace

std::unique_ptr<PendingResult> prepare_small_file(const fs::path& path, const std::string& text) {
    return std::make_unique<PendingSmallFile>(path, text);
}

void write_small_file(const fs::path& path, const std::string& text) {
    const std::unique_ptr<PendingResult> file = prepare_small_file(path, text);
    CommitList alone;
    alone.add(*file);
    alone.publish();
}

}  // namespace d2b
