#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace d2b {

/// Part of a result that is complete but not visible yet: a file under a hidden name, an open transaction,
/// bytes for a stream. It has been written, flushed to disk and verified, so that one quick step can publish
/// it.
class PendingResult {
  public:
    /// All results of one kind are published before any of the next.
    enum class Kind {
        transaction,  ///< a database transaction; cannot be rolled back
        file,         ///< written besides the layers
        dataset,      ///< the layers
        stream,       ///< cannot be rolled back, and its reader may open the files next
    };

    PendingResult() = default;
    PendingResult(const PendingResult&) = delete;
    PendingResult& operator=(const PendingResult&) = delete;
    /// Removes the result if it has not been published.
    virtual ~PendingResult() = default;

    [[nodiscard]] virtual Kind kind() const = 0;
    /// Final check before anything of the run is published. @throws OutputError, for example if the file to
    /// be replaced has changed meanwhile
    virtual void check() {}
    /// Makes the result visible and keeps the previous state. @throws OutputError; nothing has changed then
    virtual void show() = 0;
    /// Flushes to disk once the whole run is visible, and warns if that fails.
    virtual void confirm() {}
    /// Restores the previous state after show(). @return "" on success, otherwise the remaining change as a
    /// clause: "\"a.gpkg\" has been changed already"
    [[nodiscard]] virtual std::string roll_back() = 0;
    /// Discards the previous state.
    virtual void keep() {}
};

/// Publishes the results of all sinks of a run together, or none of them: the second phase of a two-phase
/// commit, whose first phase ends when a result is added. Results become visible one after the other, in one
/// go. Not atomic: a crash in between leaves some visible.
///
/// A sink of files adds its results in its prepare(). If it writes two files, it adds two results, and the
/// file that refers to the other one comes last. In lib/write each file of a surface is a FileWriter, whose
/// prepare() completes it and adds it:
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

    /// Publishes everything, then calls `tell`, which may announce it, for example by a report on the
    /// standard output. @throws OutputError after rolling back; if that is impossible, the message lists the
    /// remaining changes. @throws any other exception of `tell`, after rolling back
    void publish(const std::function<void()>& tell = {});

  private:
    void show_all(std::size_t& shown);
    [[nodiscard]] std::string roll_back(std::size_t shown) const;

    std::vector<PendingResult*> results_;
};

/// Receives the report of a run as a part of its result, for example to print it. If these functions throw,
/// the run fails and nothing is published.
template <typename Report>
struct ReportReader {
    /// Called when all files are complete and none is visible. @param report as far as it is known
    std::function<void(const Report& report)> prepare;
    /// Called when all are visible, and can still be rolled back.
    std::function<void(const Report& report)> show;
};

}  // namespace d2b
