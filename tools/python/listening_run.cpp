#include "python/listening_run.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

namespace py = pybind11;

/// News of the work that the listener has not heard yet.
struct News {
    std::vector<std::string> warnings;
    std::optional<double> share;
    bool done = false;
};

/// Meeting place of the two threads.
class Mailbox {
  public:
    /// Comes back when the warning has been heard: it may be an error there. @throws Cancelled
    void warn(const std::string& text) {
        std::unique_lock lock(mutex_);
        const std::size_t mine = ++said_;
        news_.warnings.push_back(text);
        changed_.notify_all();
        changed_.wait(lock, [&] { return heard_ >= mine || stop_; });
        if (stop_)
            throw Cancelled();
    }
    void progress(double share) {
        const std::lock_guard lock(mutex_);
        news_.share = share;
    }
    void end() {
        const std::lock_guard lock(mutex_);
        news_.done = true;
        changed_.notify_all();
    }
    [[nodiscard]] bool stopped() const { return stop_.load(std::memory_order_relaxed); }

    /// Returns the latest news, after a moment at most.
    News wait() {
        constexpr std::chrono::milliseconds moment{50};
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, moment, [this] { return news_.done || !news_.warnings.empty(); });
        return std::exchange(news_, News{{}, {}, news_.done});
    }
    /// @param go_on whether the work is to go on
    void answer(const News& news, bool go_on) {
        const std::lock_guard lock(mutex_);
        heard_ += news.warnings.size();
        stop_ = stop_ || !go_on;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    News news_;
    std::size_t said_ = 0;  ///< warnings
    std::size_t heard_ = 0;
    std::atomic<bool> stop_ = false;
};

/// Returns true if a progress function returned None or something true. Asks for its truth, because a
/// comparison of NumPy numbers gives a False that is not Python's.
bool goes_on(const py::object& answer) {
    if (answer.is_none())
        return true;
    const int truth = PyObject_IsTrue(answer.ptr());
    if (truth < 0)
        throw py::error_already_set();
    return truth != 0;
}

/// @throws pybind11::error_already_set where a warning is an error, a signal raises, or the progress function
/// does @return whether to go on
bool tell(const News& news, const py::object& listener) {
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
    for (const std::string& text : news.warnings)
        listener.attr("warn")(utf8_text(text));
    const py::object progress = listener.attr("progress");
    return !news.share || progress.is_none() || goes_on(progress(*news.share));
}

}  // namespace

void run_listening(const py::object& listener, const std::function<void(const PythonEars&)>& work) {
    Mailbox mailbox;
    const PythonEars ears{[&] { return mailbox.stopped(); },
                          [&](double share) {
                              mailbox.progress(share);
                              return !mailbox.stopped();
                          },
                          [&](const std::string& text) { mailbox.warn(text); }};
    std::exception_ptr failure;
    std::thread worker([&] {
        try {
            work(ears);
        } catch (...) {
            failure = std::current_exception();
        }
        mailbox.end();
    });
    std::optional<py::error_already_set> raised;
    for (bool done = false; !done;) {
        News news;
        {
            const py::gil_scoped_release free;
            news = mailbox.wait();
        }
        done = news.done;
        if (raised || mailbox.stopped())
            continue;  // because who has ended the run is not asked again
        try {
            mailbox.answer(news, tell(news, listener));
        } catch (py::error_already_set& error) {
            raised.emplace(std::move(error));
            mailbox.answer(news, false);
        }
    }
    {
        const py::gil_scoped_release free;
        worker.join();
    }
    if (raised)
        throw py::error_already_set(std::move(*raised));
    if (failure)
        std::rethrow_exception(failure);
}

}  // namespace d2b
