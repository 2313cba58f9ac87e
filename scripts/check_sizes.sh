#!/bin/sh
# Holds the hard limits of size: 600 lines a C file, 100 lines a function. Above 400 and 60 lines it only says so.
#
# usage: check_sizes.sh [BUILD FOLDER]     with compile_commands.json; default build/release
cd "$(dirname "$0")/.." || exit 1
build=${1:-build/release}
status=0
if [ ! -f "$build/compile_commands.json" ]; then
    echo "check_sizes.sh: $build has no compile_commands.json; run: cmake --preset release" >&2
    exit 1
fi

for file in $(sh scripts/list_sources.sh); do
    lines=$(wc -l <"$file")
    if [ "$lines" -gt 600 ]; then
        echo "$file: $lines lines, more than 600"
        status=1
    elif [ "$lines" -gt 400 ]; then
        echo "note: $file has $lines lines; which second concept lives in it?"
    fi
done

# Linux braces: a function's body stands between braces in the first column.
for file in $(sh scripts/list_sources.sh); do
    awk '/^\{$/ { first = FNR }
         /^\}$/ { if (first && FNR - first > 61) print "note: " FILENAME ":" first ": a function of " FNR - first - 1 " lines"
                  first = 0 }' "$file"
done

# .clang-tidy has the limit. clang 14 does not know the processor names in elements/dispatch.c; the fuzz target has a
# compile command in a build of its own only. Nor does clang know how GCC schedules.
commands=$(mktemp -d)
trap 'rm -rf "$commands"' EXIT
sed 's/ -fsched[a-z-]*//g' "$build/compile_commands.json" >"$commands/compile_commands.json"
sh scripts/list_sources.sh | grep '\.c$' | grep -v -e '^elements/dispatch\.c$' -e '/fuzz_' |
    xargs -P "$(nproc)" -n 16 clang-tidy -p "$commands" --quiet 2>/dev/null || status=1
exit "$status"
