#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace d2b {

/// A part of a result that is complete and does not show yet: a file under a hidden name, an open
/// transaction, bytes for a stream. It is written, on the disk and read back; one quick step shows it.
class PendingResult {
  public:
    /// All of one kind are shown before any of the next.
    enum class Kind {
        transaction,  ///< of a database, which cannot be taken back
        file,         ///< beside the layers
        dataset,      ///< the layers
        stream,       ///< cannot be taken back, and whoever reads it may go on to the files
    };

    PendingResult() = default;
    PendingResult(const PendingResult&) = delete;
    PendingResult& operator=(const PendingResult&) = delete;
    /// What does not show is removed.
    virtual ~PendingResult() = default;

    [[nodiscard]] virtual Kind kind() const = 0;
    /// The last look before anything of the run shows. @throws OutputError, say where the file that is to be
    /// replaced has changed meanwhile
    virtual void check() {}
    /// Makes it visible, and keeps what stood there before. @throws OutputError; then all is as it was
    virtual void show() = 0;
    /// When all of the run shows: makes sure that the disk remembers it, and warns where that is in doubt.
    virtual void confirm() {}
    /// After show(): puts back what stood there before. @return where that fails what is left to know, as a
    /// clause: "\"a.gpkg\" has been changed already"; "" where it is done
    [[nodiscard]] virtual std::string take_back() = 0;
    /// What stood there before is not needed any more.
    virtual void keep() {}
};

/// What belongs together: the results of all sinks of a run, which show one after the other, at once, when
/// all of them are complete, or not at all. (The first phase of a commit in two phases is done where a result
/// is added.)
///
/// A sink of files adds what it has completed in its prepare(). One that writes two files adds two results,
/// in the order in which they are to show: the file that names the other one comes last. In lib/write each
/// file of a surface is a SurfaceFile, whose prepare() completes it and adds it:
///
///     void prepare(CommitList& commit) override {
///         materials_.prepare(commit);  // a.mtl
///         model_.prepare(commit);      // a.obj, which names it
///     }
class CommitList {
  public:
    CommitList() = default;
    CommitList(const CommitList&) = delete;
    CommitList& operator=(const CommitList&) = delete;

    /// @param result must outlive publish()
    void add(PendingResult& result) { results_.push_back(&result); }

    /// Shows all of it, and calls `tell`, which says so where it is read: a report on the standard output.
    /// @throws OutputError: nothing shows then. What has been shown before is taken back; where that cannot
    /// be, the message says what has changed. @throws whatever `tell` throws, where it is not an OutputError
    void publish(const std::function<void()>& tell = {});

  private:
    void show_all(std::size_t& shown);
    [[nodiscard]] std::string take_back(std::size_t shown) const;

    std::vector<PendingResult*> results_;
};

/// Who shows the report of a run as a part of its result, on the standard output say. What these functions
/// throw ends the run, and nothing of it shows.
template <typename Report>
struct ReportReader {
    /// Called when all files are complete and none of them shows. @param report as far as it is known
    std::function<void(const Report& report)> prepare;
    /// Called when all of them show, and can still be taken back.
    std::function<void(const Report& report)> show;
};

}  // namespace d2b
