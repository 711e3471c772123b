#include "core/executor.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <typeinfo>

namespace d2b {

/// Reports its lifetime as a span of work of a thread.
class ScopedWorkSpan {
  public:
    using Clock = std::chrono::steady_clock;

    /// @param listener if null, nothing is reported and no clock is read
    ScopedWorkSpan(const WorkListener* listener, std::size_t thread, const std::type_info& work)
        : listener_(listener), span_{thread, &work, now(), {}} {}
    ScopedWorkSpan(const ScopedWorkSpan&) = delete;
    ScopedWorkSpan& operator=(const ScopedWorkSpan&) = delete;
    ~ScopedWorkSpan() { tell(); }

    /// Excludes a wait from the reported time.
    template <typename Wait>
    void interrupt(const Wait& wait) {
        tell();
        wait();
        span_.begin = now();
    }

  private:
    [[nodiscard]] Clock::time_point now() const {
        return listener_ != nullptr ? Clock::now() : Clock::time_point();
    }
    void tell() {
        if (listener_ == nullptr)
            return;
        span_.end = now();
        (*listener_)(span_);
    }

    const WorkListener* listener_;
    WorkSpan span_;
};

namespace {

/// Keeps the exception of the lowest index, which a sequential loop would throw.
class FirstFailure {
  public:
    void keep(std::size_t i, std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        if (i < limit_) {
            limit_ = i;
            failure_ = std::move(failure);
        }
    }
    /// Only indices below this still have to be processed.
    [[nodiscard]] std::size_t limit() const { return limit_; }
    void rethrow() const {
        if (failure_)
            std::rethrow_exception(failure_);
    }

  private:
    std::mutex mutex_;
    std::atomic<std::size_t> limit_ = std::numeric_limits<std::size_t>::max();
    std::exception_ptr failure_;
};

}  // namespace

struct Executor::Pool {
    std::mutex mutex;
    std::condition_variable wake;
    std::condition_variable idle;
    const Body* body = nullptr;
    const WorkListener* listener = nullptr;
    std::size_t round = 0;
    std::size_t at_work = 0;
    bool ending = false;
    std::vector<std::thread> threads;

    Pool() = default;
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool() {
        {
            const std::lock_guard lock(mutex);
            ending = true;
        }
        wake.notify_all();
        for (std::thread& thread : threads)
            thread.join();
    }
    /// @return true if all threads started
    bool start(std::size_t count) {
        try {
            threads.reserve(count);
            while (threads.size() < count)
                threads.emplace_back([this, thread = threads.size() + 1] { serve(thread); });
        } catch (const std::exception&) {
            return false;  // process limit reached, or no memory for a stack
        }
        return true;
    }
    void serve(std::size_t thread) {
        std::unique_lock lock(mutex);
        for (std::size_t done = 0;;) {
            wake.wait(lock, [&] { return ending || round != done; });
            if (ending)
                return;
            done = round;
            const Body* work = body;
            lock.unlock();
            (*work)(thread, listener);
            lock.lock();
            if (--at_work == 0)
                idle.notify_all();
        }
    }
};

Executor::Executor(int threads, std::function<bool()> stop, WorkListener on_work)
    : stop_(std::move(stop)), on_work_(std::move(on_work)), pool_(std::make_unique<Pool>()) {
    auto count = static_cast<std::size_t>(std::max(threads, 1) - 1);
    while (!pool_->start(count)) {
        // Use half of the threads that started, because the work itself needs some, too.
        count = pool_->threads.size() / 2;
        pool_ = std::make_unique<Pool>();
    }
    pool_->listener = on_work_ ? &on_work_ : nullptr;
}

Executor::~Executor() = default;

int Executor::threads() const {
    return static_cast<int>(pool_->threads.size()) + 1;
}

void Executor::run(const Body& body) {
    Pool& pool = *pool_;
    std::unique_lock lock(pool.mutex);
    const bool shared = pool.body == nullptr;  // otherwise this is a nested call
    if (shared) {
        pool.body = &body;
        pool.at_work = pool.threads.size();
        ++pool.round;
    }
    lock.unlock();
    if (shared)
        pool.wake.notify_all();
    body(0, shared ? pool.listener : nullptr);
    if (!shared)
        return;
    lock.lock();
    pool.idle.wait(lock, [&] { return pool.at_work == 0; });
    pool.body = nullptr;
}

void Executor::indexed(std::size_t count, const Indexed& work) {
    if (count <= 1) {  // Small rasters: waking other threads takes longer than the work.
        if (count == 1) {
            stop_.check();
            work(0, 0);
        }
        return;
    }
    FirstFailure failure;
    std::atomic<std::size_t> next = 0;
    run([&](std::size_t thread, const WorkListener* listener) {
        const ScopedWorkSpan stretch(listener, thread, work.target_type());
        for (std::size_t i = next++; i < std::min(count, failure.limit()); i = next++)
            try {
                stop_.check();
                work(i, thread);
            } catch (...) {
                failure.keep(i, std::current_exception());
            }
    });
    failure.rethrow();
}

void Executor::pipelined(std::size_t count, std::size_t ahead, const Indexed& make,
                         const std::function<void(std::size_t)>& take) {
    FirstFailure failure;
    std::mutex mutex;
    std::condition_variable moved;
    std::size_t next = 0;   // next index to make
    std::size_t taken = 0;  // number taken; the slots after it may be filled
    std::vector<bool> made(ahead);
    const auto can_make = [&] { return next < count && next < taken + made.size(); };
    const auto make_next = [&](std::unique_lock<std::mutex>& lock, std::size_t thread) {
        const std::size_t i = next++;
        lock.unlock();
        try {
            stop_.check();
            make(i, thread);
        } catch (...) {
            failure.keep(i, std::current_exception());
        }
        lock.lock();
        made[i % made.size()] = true;
        moved.notify_all();
    };
    run([&](std::size_t thread, const WorkListener* listener) {
        ScopedWorkSpan stretch(listener, thread, make.target_type());
        std::unique_lock lock(mutex);
        while (taken < std::min(count, failure.limit())) {
            if (thread == 0 && made[taken % made.size()]) {
                const std::size_t i = taken;
                lock.unlock();
                try {
                    stop_.check();
                    take(i);
                } catch (...) {
                    failure.keep(i, std::current_exception());
                }
                lock.lock();
                made[i % made.size()] = false;
                ++taken;
                moved.notify_all();
            } else if (can_make() && next < failure.limit()) {
                make_next(lock, thread);
            } else {
                stretch.interrupt([&] { moved.wait(lock); });
            }
        }
        moved.notify_all();
    });
    failure.rethrow();
}

}  // namespace d2b
