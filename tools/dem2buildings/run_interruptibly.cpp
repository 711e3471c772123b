#include "dem2buildings/run_interruptibly.hpp"

#include <exception>

#include "common/exit_codes.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/interrupt.hpp"

namespace d2b {

int run_interruptibly(const std::function<void()>& run) {
    catch_interrupts();
    try {
        run();
    } catch (const std::exception&) {
        if (!interrupted())
            throw;
        print_line("ERROR: ", Cancelled().what());
        return interrupt_status();
    }
    return exit_code::done;
}

}  // namespace d2b
