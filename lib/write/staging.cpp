#include "write/staging.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include "core/system/paths.hpp"
#include "core/system/process.hpp"
#include "dem2buildings/error.hpp"

namespace d2b::writing {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_errno(int number) {
    throw std::system_error(number, std::generic_category());
}

}  // namespace

RenameTransaction::~RenameTransaction() {
    static_cast<void>(roll_back());
}

bool RenameTransaction::undo(const Rename& move) {
    if (move.exchanged)
        return system::exchange(move.from, move.to) == 0;
    std::error_code error;
    fs::rename(move.to, move.from, error);
    return !error;
}

std::vector<fs::path> RenameTransaction::roll_back() {
    std::vector<fs::path> left;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move)
        if (!undo(*move))
            left.push_back(move->exchanged ? move->from : move->to);
    done_.clear();
    return left;
}

void RenameTransaction::move(const fs::path& from, const fs::path& to) {
    done_.reserve(done_.size() + 1);
    if (const int error = system::rename_to_free_name(from, to); error != 0) {
        if (!system::is_unsupported(error))
            throw_errno(error);
        if (fs::exists(fs::symlink_status(to)))
            throw_errno(EEXIST);
        fs::rename(from, to);
    }
    done_.push_back({from, to});
}

void RenameTransaction::replace(const fs::path& from, const fs::path& to, const fs::path& spare) {
    done_.reserve(done_.size() + 2);
    const int error = system::exchange(from, to);
    if (error == 0) {
        done_.push_back({from, to, true});
        return;
    }
    if (!system::is_unsupported(error))
        throw_errno(error);
    if (fs::is_directory(to)) {
        RenameTransaction both;
        both.move(to, spare);
        both.move(from, to);
        done_.insert(done_.end(), both.done_.begin(), both.done_.end());
        both.keep();
        return;
    }
    std::error_code no_links;
    fs::create_hard_link(to, spare, no_links);
    if (no_links)
        fs::copy_file(to, spare);
    fs::rename(from, to);
    done_.push_back({to, spare});
}

void sync_to_disk(const fs::path& path) {
    if (const int error = system::sync(path); error != 0)
        throw_errno(error);
}

namespace {

fs::path parent_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

OutputError cannot_write(const std::string& name, const std::string& reason) {
    return OutputError("Cannot write \"" + name + "\": " + reason + ".");
}

/// Copies the permissions of the replaced file.
void take_permissions(const fs::path& from, const fs::path& to) {
    std::error_code error;
    const fs::file_status status = fs::status(from, error);
    if (!error && fs::is_regular_file(status))
        fs::permissions(to, status.permissions(), error);
}

}  // namespace

StagingFolder::StagingFolder(std::string name, fs::path destination)
    : name_(std::move(name)), destination_(std::move(destination)) {
    const fs::path parent = parent_of(destination_);
    // Leave out the extension, because /vsizip/ would take "a.ods" anywhere in a path for an archive.
    std::string pattern = (parent / ".dem2buildings.XXXXXX").string();
    if (!system::make_unique_folder(pattern))
        throw cannot_write(name_, "no file can be created in \"" + parent.string() + "\" (" +
                                      std::generic_category().message(errno) +
                                      "); choose another destination");
    folder_ = pattern;
}

StagingFolder::~StagingFolder() {
    moves_.keep();
    std::error_code ignored;
    if (!keeps_old_)
        fs::remove_all(folder_, ignored);
}

void StagingFolder::copy_in(const std::vector<std::string>& files) {
    try {
        if (fs::is_directory(destination_))
            fs::copy(destination_, dataset(), fs::copy_options::recursive);
        else
            for (const fs::path file : files)
                fs::copy_file(file, folder_ / file.filename());
    } catch (const fs::filesystem_error& error) {
        throw cannot_write(name_, "it cannot be copied (" + error.code().message() + ")");
    }
}

void StagingFolder::seal() {
    result_.clear();
    for (const auto& entry : fs::directory_iterator(folder_))
        result_.push_back(entry.path().filename());
    const fs::path main = destination_.filename();
    std::sort(result_.begin(), result_.end(), [&main](const fs::path& a, const fs::path& b) {
        return std::pair(a == main, a) < std::pair(b == main, b);
    });
    if (result_.empty() || result_.back() != main)
        throw cannot_write(name_, "the driver did not write a file of this name");
    for (const fs::path& file : result_)
        take_permissions(parent_of(destination_) / file, folder_ / file);
}

void StagingFolder::sync() const {
    try {
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            sync_to_disk(entry.path());
    } catch (const std::system_error& error) {
        throw cannot_write(name_, error.code().message());
    }
}

void StagingFolder::publish(const std::vector<std::string>& old_files) {
    try {
        if (fs::is_directory(dataset()))
            publish_folder(!old_files.empty());
        else
            publish_files(old_files);
    } catch (const std::system_error& error) {
        const std::string left = roll_back();
        throw cannot_write(name_, "the finished result cannot be renamed (" + error.code().message() + ")" +
                                      (left.empty() ? "" : "; " + left));
    }
}

std::string StagingFolder::confirm() const {
    try {
        sync_to_disk(parent_of(destination_));
    } catch (const std::system_error& error) {
        return error.code().message();
    }
    return "";
}

std::string StagingFolder::roll_back() {
    const std::vector<fs::path> left = moves_.roll_back();
    if (left.empty())
        return "";
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_, ignored))
        if (std::ranges::find(left, entry.path()) == left.end())
            fs::remove_all(entry.path(), ignored);
        else
            keeps_old_ = true;
    if (keeps_old_)
        return "old files of \"" + name_ + "\" lie in \"" + folder_.string() + "\" now";
    return fs::exists(destination_, ignored) ? "\"" + name_ + "\" already exists" : "";
}

void StagingFolder::publish_folder(bool replaces) {
    if (!fs::exists(fs::symlink_status(destination_))) {
        moves_.move(dataset(), destination_);
        return;
    }
    // An empty folder may exist already; files of others must not be lost.
    if (!replaces && !(fs::is_directory(destination_) && fs::is_empty(destination_)))
        throw std::system_error(EEXIST, std::generic_category());
    moves_.replace(dataset(), destination_, folder_ / "old");
}

void StagingFolder::publish_files(const std::vector<std::string>& old_files) {
    std::set<fs::path> old;
    for (const fs::path file : old_files)
        old.insert(file.filename());
    const fs::path parent = parent_of(destination_);
    for (const fs::path& file : old)
        if (std::ranges::find(result_, file) == result_.end())
            moves_.move(parent / file, folder_ / file);
    for (const fs::path& file : result_)
        if (old.contains(file))
            moves_.replace(folder_ / file, parent / file, folder_ / (file.string() + ".old"));
        else
            moves_.move(folder_ / file, parent / file);
}

PendingFiles::PendingFiles(Kind kind, const std::string& name, const std::filesystem::path& destination,
                           ReplacedFiles old, Warnings& warnings)
    : kind_(kind), name_(name), old_(std::move(old)), warnings_(warnings) {
    staging_.emplace(name, destination);
}

void PendingFiles::check() {
    require_unchanged(name_, old_);
}

void PendingFiles::confirm() {
    const std::string doubt = staging_->confirm();
    if (!doubt.empty())
        warnings_.add(
            "\"" + name_ +
            "\" is written, but may be lost after a power failure: the disk does not confirm its name (" +
            doubt + ").");
}

std::string stamp_of(const std::vector<std::string>& files) {
    std::string stamp;
    const auto add = [&stamp](const fs::path& path) {
        if (const std::string text = system::stamp_of(path); !text.empty())
            stamp += path.string() + '|' + text + '\n';
    };
    std::error_code error;
    for (const std::string& file : files) {
        add(file);
        if (fs::is_directory(file, error))
            for (const auto& entry : fs::directory_iterator(file))
                add(entry.path());
    }
    return stamp;
}

void require_unchanged(const std::string& name, const ReplacedFiles& old) {
    if (!old.files.empty() && stamp_of(old.files) != old.stamp)
        throw OutputError("\"" + name + "\" changed during this run and was left alone; run again.");
}

namespace {

class PendingTextFile final : public PendingResult {
  public:
    PendingTextFile(fs::path path, const std::string& text);
    ~PendingTextFile() override;

    [[nodiscard]] Kind kind() const override { return Kind::file; }
    void show() override;
    [[nodiscard]] std::string roll_back() override;
    void keep() override { moves_.keep(); }

  private:
    [[noreturn]] void fail(const std::system_error& error) const;
    [[nodiscard]] fs::path spare() const { return hidden_.string() + ".old"; }

    fs::path path_;
    fs::path hidden_;
    RenameTransaction moves_;
};

PendingTextFile::PendingTextFile(fs::path path, const std::string& text)
    : path_(std::move(path)),
      // Process ids may coincide between machines, so append a random number.
      hidden_(path_.parent_path() /
              ("." + path_.filename().string() + "." + std::to_string(system::process_id()) + "." +
               std::to_string(std::random_device()()))) {
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

PendingTextFile::~PendingTextFile() {
    moves_.keep();
    std::error_code ignored;
    fs::remove(hidden_, ignored);
    fs::remove(spare(), ignored);
}

void PendingTextFile::fail(const std::system_error& error) const {
    throw OutputError("\"" + path_.string() + "\" cannot be written: " + error.code().message() +
                      "; free some space, or allow writing to it.");
}

void PendingTextFile::show() {
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

std::string PendingTextFile::roll_back() {
    return moves_.roll_back().empty() ? "" : "\"" + path_.string() + "\" has been written already";
}

}  // namespace

std::unique_ptr<PendingResult> prepare_text_file(const fs::path& path, const std::string& text) {
    return std::make_unique<PendingTextFile>(path, text);
}

void write_text_file(const fs::path& path, const std::string& text) {
    const std::unique_ptr<PendingResult> file = prepare_text_file(path, text);
    CommitList alone;
    alone.add(*file);
    alone.publish();
}

}  // namespace d2b::writing
