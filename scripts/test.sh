#!/bin/sh
# Installs what is missing, builds billow and runs its tests. The last line counts them: N passed, N failed[, N skipped].
#
# usage: test.sh [PRESET [CTEST OPTION ...]]     PRESET: release (default), debug, asan, tsan
# Fails if anything does. Everything the tests said is in build/PRESET/Testing/Temporary/LastTest.log.
set -u
cd "$(dirname "$0")/.." || exit 1
preset=${1:-release}
[ $# -eq 0 ] || shift
quiet=
[ -t 1 ] || quiet="-- --quiet" # a log needs no line for each file that compiled

if ! { sh scripts/setup.sh && cmake --preset "$preset" && cmake --build --preset "$preset" $quiet; }; then
    echo "test.sh: the build failed; see above" >&2
    echo "0 passed, 1 failed"
    exit 1
fi

log=build/$preset/Testing/Temporary/LastTest.log
rm -f "$log"
ctest --preset "$preset" -j "$(nproc)" "$@"
status=$?
# A run without a failing case that ctest calls a failure is one, too: a crash, a time limit.
counts=$(awk -f scripts/count_tests.awk "$log") || status=1
if [ "$status" -ne 0 ] && [ "${counts#* passed, 0 failed}" != "$counts" ]; then
    counts=$(echo "$counts" | sed 's/0 failed/1 failed/')
fi
echo "${counts:-0 passed, 1 failed}"
exit "$status"
