// For builds that look for races: programs believe that there are four processors, whatever the machine has,
// and start as many threads where they are told of no number.
#include <sys/sysinfo.h>

extern "C" int get_nprocs() noexcept {
    return 4;
}
