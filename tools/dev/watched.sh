# Functions of test.sh, which reads this file: they print the output of builds and tests for people.

# logged log filter command...: all output of the command goes to the log, and the lines that pass the filter to stdout.
# The status is the command's.
logged() {
    log=$1
    filter=$2
    shift 2
    { "$@" 2>&1 && echo 0 >"$log.status" || echo $? >"$log.status"; } | tee -a "$log" | "$filter"
    status=$(cat "$log.status")
    rm "$log.status"
    return "$status"
}

# A line for each tenth of the way; errors and warnings whole.
build_progress() {
    awk '
        /^\[ *[0-9]+(\/[0-9]+|%)\] / {
            split($0, step, /[][ \/%]+/)
            share = $0 ~ /^\[ *[0-9]+%/ ? step[2] : 100 * step[2] / step[3]
            if (int(share / 10) > tenth) {
                tenth = int(share / 10)
                print "  " 10 * tenth " % built"
                fflush()
            }
            next
        }
        /^-- / || /^ninja: / || /^$/ { next }
        { print; fflush() }'
}

# Prints a line for each tenth of the way, failed tests with all their output, and one line at the end.
test_progress() {
    # The numbers of CTest have a point.
    LC_ALL=C awk '
        / Test +#[0-9]+: / {
            split($1, place, "/")
            if (int(10 * place[1] / place[2]) > tenth) {
                tenth = int(10 * place[1] / place[2])
                print "  " 10 * tenth " % of " place[2] " tests"
            }
            if (!/Passed|Skipped|Disabled/)
                print
            fflush()
            next
        }
        / tests passed, .* out of / {
            failed = $4
            count = $NF
            ended = 1
        }
        /\((Skipped|Disabled)\)/ { ++skipped }
        /^Total Test time/ { seconds = int($6 + 0.5) }
        ended || /^ *Start +[0-9]+: / || /^(Test project|Internal ctest) / || /^$/ { next }
        { print; fflush() }
        END {
            if (count == 0)
                exit
            print (failed > 0 ? failed " of " count " tests failed" : "All " count " tests passed") \
                (skipped > 0 ? " (" skipped " skipped)" : "") " in " seconds " s"
        }'
}
